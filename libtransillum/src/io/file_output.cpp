// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <system_error>

#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

namespace fs = std::filesystem;

std::string words(int error_number) { return std::generic_category().message(error_number); }

[[noreturn]] void fail(const fs::path& path, int error_number) {
  throw std::runtime_error(
      fmt::format("{}: cannot be written: {}", path.string(),
                  error_number ? words(error_number) : std::string("input/output error")));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A file of its own in the folder of the target, so that the rename stays on one file system.
/// Removed unless it was renamed.
class TemporaryNeighbor {
 public:
  explicit TemporaryNeighbor(const fs::path& target) : target_(target) {
    static std::atomic<unsigned> counter{0};
    int file = -1;
    do {
      // Short and independent of the target's name, which may already be as long as names can be.
      path_ = folder_of(target) / fmt::format(".transillum-{}-{}.tmp", ::getpid(), counter++);
      file = ::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    } while (file < 0 && errno == EEXIST);
    if (file < 0) {
      fail(target, errno);
    }
    ::close(file);
  }
  ~TemporaryNeighbor() {
    std::error_code ignored;
    if (!path_.empty()) {
      fs::remove(path_, ignored);
    }
  }
  TemporaryNeighbor(const TemporaryNeighbor&) = delete;
  TemporaryNeighbor& operator=(const TemporaryNeighbor&) = delete;

  const fs::path& path() const { return path_; }

  void become_target() {
    synchronize();
    std::error_code ignored;
    const fs::file_status old = fs::status(target_, ignored);
    if (fs::exists(old)) {
      fs::permissions(path_, old.permissions(), ignored);
    }
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) {
      fail(target_, error.value());
    }
    path_.clear();
  }

 private:
  /// Without it a crash of the machine could leave the new name with no content.
  void synchronize() const {
    const int file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) {
      fail(target_, errno);
    }
    const int error = ::fsync(file) == 0 ? 0 : errno;
    ::close(file);
    // Some file systems cannot, which is no reason to lose the result.
    if (error != 0 && error != EINVAL && error != ENOTSUP) {
      fail(target_, error);
    }
  }

  fs::path target_, path_;
};

void fill(const fs::path& file, const fs::path& target,
          const std::function<void(std::ostream&)>& write) {
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (out) {
    write(out);
  }
  out.flush();
  const int error = errno;
  if (!out) {
    fail(target, error);
  }
  out.close();
  if (!out) {
    fail(target, errno);
  }
}

/// Where a chain of symbolic links leads, so that the link stays and its target is replaced.
fs::path behind_links(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) {
    return path;
  }
  fs::path resolved = fs::weakly_canonical(path, error);
  return error ? path : resolved;
}

}  // namespace

void write_file_whole(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write) {
  std::error_code ignored;
  const fs::path target = behind_links(path);
  const fs::file_status status = fs::status(target, ignored);
  if (fs::is_directory(status)) {
    fail(path, EISDIR);
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    fill(target, path, write);  // a device: nothing to rename
    return;
  }
  TemporaryNeighbor neighbor(target);
  fill(neighbor.path(), path, write);
  neighbor.become_target();
}

void check_writable(const std::filesystem::path& path) {
  std::error_code ignored;
  const fs::path target = behind_links(path);
  if (path.empty()) {
    throw InputError("the name of an output file is empty");
  }
  if (fs::is_directory(target, ignored)) {
    throw InputError(fmt::format("{}: cannot be written: it is a folder", path.string()));
  }
  // To open one waits for a reader, deaf to every signal.
  if (fs::is_fifo(target, ignored)) {
    throw InputError(fmt::format("{}: cannot be written: it is a pipe", path.string()));
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    return;
  }
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, ignored)) {
    throw InputError(fmt::format("{}: cannot be written: there is no folder {}", path.string(),
                                 folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), words(errno)));
  }
}

}  // namespace transillum
