#pragma once
#include <filesystem>
#include <string>

namespace undine {

struct ViewOptions {
  std::filesystem::path folder;    ///< of a run
  std::string host = "127.0.0.1";  ///< address that is listened on
  int port = 0;                    ///< 0: any that is free
  bool follow = false;             ///< whether the page goes on to each new snapshot
};

/// `undine view`: serves the page of a run to this machine's browsers until it is interrupted. It reads the run's files
/// and writes none. Throws InputError, Error.
int view_command(const ViewOptions& options);

}  // namespace undine
