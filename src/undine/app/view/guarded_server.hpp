#pragma once
#include <httplib.h>

namespace undine {

/// An HTTP server that bounds what one client can take: a request must be whole within some seconds of its first byte
/// and within some kilobytes, a client that takes no more of its answer is left, and so many are served at a time that
/// a few hundred slow ones keep nobody waiting.
class GuardedServer : public httplib::Server {
 public:
  GuardedServer();

 private:
  /// Called by one of the threads, for each connection.
  bool process_and_close_socket(socket_t socket) override;
};

}  // namespace undine
