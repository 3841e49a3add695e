#pragma once
#include <filesystem>
#include <utility>

namespace undine {

enum class FolderMode {
  fresh,     ///< the folder must be new or empty
  resume,    ///< it must exist; all that it holds stays, but what a run that went bad said of it
  overwrite  ///< may hold an earlier run, all of whose files are removed
};

/// The right to write to a folder, which one run at a time has: a lock on its file `.undine`, which ends with this
/// object and with the process, however that ends. Where the file system knows no locks everybody has it.
class FolderClaim {
 public:
  FolderClaim() = default;
  FolderClaim(FolderClaim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderClaim& operator=(FolderClaim&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FolderClaim();

  /// Of a folder that a run has written to; of any other none is needed, or made. Throws InputError where a run still
  /// writes.
  static FolderClaim of(const std::filesystem::path& folder);

 private:
  friend FolderClaim prepare_output_folder(const std::filesystem::path& folder, FolderMode mode, FolderClaim claim);
  explicit FolderClaim(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// Makes the folder (with its parents) ready for a run, and tries to write to it. A prepared folder holds the small
/// file `.undine`, without which `overwrite` touches nothing. Returns the claim, or the one that was had already.
/// Throws InputError, naming the folder and the remedy: it is not empty, is a file, cannot be written, has nothing to
/// resume, or another run writes to it.
[[nodiscard]] FolderClaim prepare_output_folder(const std::filesystem::path& folder, FolderMode mode,
                                                FolderClaim claim = {});

}  // namespace undine
