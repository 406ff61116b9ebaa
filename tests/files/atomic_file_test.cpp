#include "files/atomic_file.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <set>

#include "files/error.hpp"
#include "tests/figures/scratch.hpp"

namespace {

using namespace shakebed;
namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

/// Makes writes beyond `bytes` fail as on a full disk, within its scope.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limited = before_;
    limited.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_CASE("A written file has its bytes, missing folders and nothing beside it") {
  const tests::ScratchFolder scratch;
  const fs::path file = scratch.path() / "a" / "b" / "table.csv";
  const std::string text("line 1\r\n\0line 2", 15);
  files::write_text(file, text);
  CHECK(files::read_text(file) == text);
  files::write_text(file, "");
  CHECK(files::read_text(file).empty());
  CHECK(names_in(file.parent_path()) == std::vector<std::string>{"table.csv"});
}

TEST_CASE("A write that fails half way leaves the old file and no temporary") {
  const tests::ScratchFolder scratch;
  const fs::path file = scratch.path() / "table.csv";
  files::write_text(file, "old");
  files::Fault fault;
  {
    const FileSizeLimit limit(1000);
    fault = tests::fault_of([&] { files::write_text(file, std::string(5000, 'x')); });
  }
  CHECK(fault.where == file.string());
  CHECK_THAT(fault.what, Catch::Contains("cannot write: File too large"));
  CHECK(names_in(scratch.path()) == std::vector<std::string>{"table.csv"});
  CHECK(files::read_text(file) == "old");
}

TEST_CASE("A name that cannot be taken is refused and the temporary removed") {
  const tests::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "taken";
  fs::create_directories(folder / "inside");
  const auto fault = tests::fault_of([&] { files::write_text(folder, "text"); });
  CHECK(fault.where == folder.string());
  CHECK_THAT(fault.what, Catch::Contains("nothing was written"));
  CHECK(names_in(scratch.path()) == std::vector<std::string>{"taken"});
}

TEST_CASE("A folder that cannot be made is named") {
  const tests::ScratchFolder scratch;
  const fs::path file = scratch.file("plain", "text") / "below.csv";
  CHECK_THAT(tests::fault_of([&] { files::write_text(file, "text"); }).what,
             Catch::Contains("cannot make its folder"));
}

TEST_CASE("Publishing what was never written is an error") {
  const tests::ScratchFolder scratch;
  const fs::path target = scratch.path() / "run.h5";
  const auto fault =
      tests::fault_of([&] { files::publish(files::temporary_beside(target), target); });
  CHECK_THAT(fault.what, Catch::Contains("No such file"));
  CHECK(names_in(scratch.path()).empty());
}

TEST_CASE("Temporaries are hidden, in the target's folder, and never the same") {
  std::set<fs::path> seen;
  for (int i = 0; i < 100; ++i) {
    const fs::path temporary = files::temporary_beside("data/run.h5");
    CHECK(temporary.parent_path() == "data");
    CHECK(temporary.filename().string().starts_with(".run.h5."));
    CHECK(seen.insert(temporary).second);
  }
  CHECK(files::temporary_beside("run.h5").parent_path() == ".");
}

TEST_CASE("Reading says why it cannot") {
  const tests::ScratchFolder scratch;
  const auto what = [&](const fs::path& file) {
    return tests::fault_of([&] { files::read_text(file); }).what;
  };
  CHECK(what(scratch.path() / "none") == "there is no such file");
  CHECK(what(scratch.path()) == "is a folder, expected a file");
}

}  // namespace
