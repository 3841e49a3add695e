#pragma once

namespace undine {

/// Bounds how long threads that wait for others spin, to about 10 us, unless the environment says something of it
/// (OMP_WAIT_POLICY, GOMP_SPINCOUNT). By itself libgomp lets them spin for some ms, for which a thread that another
/// program keeps from its core costs a core at each barrier: two runs side by side took ten times as long and more.
/// libgomp reads the environment before main and offers no other way in, so the program starts once more, with the same
/// process id, arguments and files. Where that is not possible it goes on as it is. Call it before anything is opened.
void bound_spinning(char** argv);

}  // namespace undine
