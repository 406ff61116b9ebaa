#include "files/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "files/error.hpp"

namespace shakebed::files {

namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::strerror(error); }

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, mode_t mode = 0)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  bool open() const { return number_ >= 0; }
  int number() const { return number_; }

  /// Closing can be the first to report a full disk on a network file system.
  bool close() {
    const int result = ::close(number_);
    number_ = -1;
    return result == 0;
  }

 private:
  int number_;
};

/// Removes the temporary and gives the error to throw; errno is read before anything else runs.
Error given_up(const fs::path& temporary, const fs::path& target, const std::string& step) {
  const std::string why = reason(errno);
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return failed(target.string(), "cannot " + step + ": " + why + "; nothing was written there");
}

fs::path folder_of(const fs::path& target) {
  const fs::path folder = target.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  // Processes of several hosts may share the folder, so the process id alone is not unique.
  char host[256] = "host";
  (void)::gethostname(host, sizeof host - 1);
  const std::string name = "." + target.filename().string() + "." + host + "." +
                           std::to_string(::getpid()) + "." + std::to_string(counter++) + ".tmp";
  return folder_of(target) / name;
}

void publish(const fs::path& temporary, const fs::path& target) {
  {
    Descriptor file(temporary, O_RDONLY);
    if (!file.open()) throw given_up(temporary, target, "open its temporary file");
    if (::fsync(file.number()) != 0) throw given_up(temporary, target, "flush it to disk");
  }
  if (::rename(temporary.c_str(), target.c_str()) != 0) {
    throw given_up(temporary, target, "give the finished file its name");
  }
  // Without this the name itself may be lost in a power cut; some file systems cannot do it.
  const Descriptor folder(folder_of(target), O_RDONLY | O_DIRECTORY);
  if (folder.open()) (void)::fsync(folder.number());
}

void write_text(const fs::path& target, std::string_view text) {
  std::error_code error;
  fs::create_directories(folder_of(target), error);
  if (error) throw failed(target.string(), "cannot make its folder: " + error.message());
  const fs::path temporary = temporary_beside(target);
  {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (!file.open()) throw failed(target.string(), "cannot create the file: " + reason(errno));
    if (!write_all(file.number(), text) || !file.close()) {
      throw given_up(temporary, target, "write");
    }
  }
  publish(temporary, target);
}

std::string read_text(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw bad_input(file.string(), "there is no such file");
  if (fs::is_directory(status)) throw bad_input(file.string(), "is a folder, expected a file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  // An empty file sets failbit on `text` alone.
  if (!stream) {
    throw bad_input(file.string(), "cannot be read" + (errno ? ": " + reason(errno) : ""));
  }
  return text.str();
}

}  // namespace shakebed::files
