#include "sweeps/store/cache.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "files/atomic_file.hpp"
#include "files/error.hpp"
#include "sweeps/store/hdf5.hpp"
#include "sweeps/store/run_key.hpp"
#include "tests/store/example_record.hpp"

namespace shakebed::tests {
namespace {

namespace fs = std::filesystem;
using sweeps::store::Cache;
using sweeps::store::RunIdentity;

RunIdentity identity_of(const simulator::Record& record) {
  return {sweeps::store::run_key(record.canonical_scene, record.physics_version, record.seed),
          record.canonical_scene, record.physics_version};
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) found.push_back(entry.path());
  }
  return found;
}

TEST_CASE("What is put into the cache is found there, and nothing else") {
  const TemporaryFolder folder;
  const Cache cache(folder.path() / "cache");
  const auto record = example_record();
  const auto run = identity_of(record);
  CHECK_FALSE(cache.find(run).run);
  CHECK_FALSE(fs::exists(cache.folder()));
  cache.put(run, record, {});
  CHECK(cache.file_of(run.key) == cache.folder() / run.key.substr(0, 2) / (run.key + ".h5"));
  const auto found = cache.find(run);
  REQUIRE(found.run);
  CHECK(same_record(found.run->record, record, true));
  auto other = record;
  other.seed += 1;
  CHECK_FALSE(cache.find(identity_of(other)).run);
}

TEST_CASE("The cache's place: asked for, environment, build/cache") {
  ::unsetenv("SHAKEBED_CACHE");
  CHECK(Cache::place(std::nullopt) == fs::path("build/cache"));
  ::setenv("SHAKEBED_CACHE", "/somewhere", 1);
  CHECK(Cache::place(std::nullopt) == fs::path("/somewhere"));
  CHECK(Cache::place("here") == fs::path("here"));
  ::unsetenv("SHAKEBED_CACHE");
}

TEST_CASE("A damaged or foreign run is reported, and can be replaced") {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  const auto record = example_record();
  const auto run = identity_of(record);
  cache.put(run, record, {});
  const auto file = cache.file_of(run.key);
  const std::string whole = files::read_text(file);

  SECTION("truncated") { files::write_text(file, whole.substr(0, whole.size() / 2)); }
  SECTION("empty") { files::write_text(file, ""); }
  SECTION("another scene under this name") {
    auto other = record;
    other.canonical_scene += "# other\n";
    sweeps::store::write_run_file(file, other, {});
  }
  SECTION("another physics version under this name") {
    auto other = record;
    other.physics_version += 1;
    sweeps::store::write_run_file(file, other, {});
  }
  const auto found = cache.find(run);
  CHECK_FALSE(found.run);
  CHECK_THAT(found.problem, Catch::Contains(file.string()));
  cache.put(run, record, {});
  CHECK(cache.find(run).run);
}

TEST_CASE("A run of another schema is an error, not a reason to overwrite it") {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  const auto run = identity_of(example_record());
  std::string image;
  {
    auto memory = sweeps::store::hdf5::File::create("foreign");
    memory.root().write_attribute("format", "shakebed run");
    memory.root().write_attribute("schema", std::int64_t{99});
    image = std::move(memory).finish();
  }
  files::write_text(cache.file_of(run.key), image);
  CHECK_THROWS_AS(cache.find(run), files::Error);
  CHECK_THROWS_WITH(cache.find(run), Catch::Contains("another schema"));
  CHECK(files::read_text(cache.file_of(run.key)) == image);
}

TEST_CASE("A folder of another layout, or a file, is refused as a cache") {
  const TemporaryFolder folder;
  files::write_text(folder.path() / "LAYOUT", "shakebed cache, layout 2\n");
  CHECK_THROWS_WITH(Cache(folder.path()),
                    Catch::Contains("cache from another schema") && Catch::Contains("layout 2"));
  CHECK_THROWS_WITH(Cache(folder.path() / "LAYOUT"), Catch::Contains("not a folder"));
}

TEST_CASE("A failure is noted until the run succeeds") {
  const TemporaryFolder folder;
  const Cache cache(folder.path());
  const auto record = example_record();
  const auto run = identity_of(record);
  CHECK_FALSE(cache.failure_of(run.key));
  cache.note_failure(run, "the bed never settles");
  CHECK(cache.failure_of(run.key) == "the bed never settles");
  CHECK_FALSE(cache.find(run).run);
  cache.put(run, record, {});
  CHECK_FALSE(cache.failure_of(run.key));
}

TEST_CASE("Processes that share a cache see only whole files") {
  const TemporaryFolder folder;
  auto record = example_record();
  constexpr int runs = 20;
  constexpr int processes = 3;
  std::vector<pid_t> children;
  for (int process = 0; process < processes; ++process) {
    const pid_t child = ::fork();
    if (child == 0) {
      bool whole = true;
      const Cache cache(folder.path());
      for (int k = 0; k < runs; ++k) {
        record.seed = static_cast<std::uint64_t>(k);
        const auto run = identity_of(record);
        whole = whole && cache.find(run).problem.empty();
        cache.put(run, record, {});
        whole = whole && cache.find(run).run.has_value();
      }
      ::_exit(whole ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
  }
  CHECK(files_below(folder.path()).size() == runs + 1);  // and LAYOUT; no temporary is left
}

TEST_CASE("A process killed while it writes leaves no file under a final name that is not whole") {
  const TemporaryFolder folder;
  auto record = example_record();
  record.series.back().values.resize(2000000, 0.5);  // 16 MB, so that kills land within writes
  int interrupted_writes = 0;
  for (int trial = 0; trial < 6; ++trial) {
    record.seed = static_cast<std::uint64_t>(trial);
    const auto run = identity_of(record);
    const pid_t child = ::fork();
    if (child == 0) {
      Cache(folder.path()).put(run, record, {});
      ::_exit(0);
    }
    // Kill as soon as the temporary file shows.
    const auto shown = [&] {
      std::error_code ignored;
      for (fs::directory_iterator entry(folder.path() / run.key.substr(0, 2), ignored), end;
           entry != end; entry.increment(ignored)) {
        if (entry->path().filename().string().find(run.key) != std::string::npos) return true;
      }
      return false;
    };
    int status = 0;
    while (!shown() && ::waitpid(child, &status, WNOHANG) == 0) ::usleep(20);
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    const auto found = Cache(folder.path()).find(run);
    CHECK(found.problem.empty());
    if (!found.run) ++interrupted_writes;
  }
  CHECK(interrupted_writes > 0);
}

}  // namespace
}  // namespace shakebed::tests
