#include "sweeps/store/run_file.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <optional>
#include <random>

#include "files/atomic_file.hpp"
#include "files/error.hpp"
#include "sweeps/store/hdf5.hpp"
#include "tests/store/example_record.hpp"

namespace shakebed::tests {
namespace {

using files::Error;
using sweeps::store::Provenance;
using sweeps::store::read_run_file;
using sweeps::store::write_run_file;

const Provenance some_provenance{"0.1.0",  "0123456789ab", "GNU 12", "-O3",
                                 "native", "release",      "a CPU"};

TEST_CASE("A run file gives back the record bit for bit") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "sub" / "run.h5";
  const auto record = example_record();
  write_run_file(file, record, some_provenance);
  const auto read = read_run_file(file);
  CHECK(same_record(read.record, record, /*timing_too=*/true));
  CHECK(read.provenance.git_revision == some_provenance.git_revision);
  CHECK(read.provenance.compiler_flags == some_provenance.compiler_flags);
  CHECK(read.provenance.cpu == some_provenance.cpu);
}

TEST_CASE("A record without lists comes back without them") {
  const TemporaryFolder folder;
  simulator::Record record;
  record.canonical_scene = "scene: 1\n";
  write_run_file(folder.path() / "run.h5", record, {});
  CHECK(same_record(read_run_file(folder.path() / "run.h5").record, record, true));
}

TEST_CASE("Equal runs give equal files; only /timing may differ") {
  const TemporaryFolder folder;
  auto record = example_record();
  write_run_file(folder.path() / "a.h5", record, some_provenance);
  ::usleep(1100000);  // HDF5 stores times in whole seconds when it is let
  write_run_file(folder.path() / "b.h5", record, some_provenance);
  CHECK((files::read_text(folder.path() / "a.h5") == files::read_text(folder.path() / "b.h5")));
  record.timing.cpu_seconds += 1;
  write_run_file(folder.path() / "b.h5", record, some_provenance);
  CHECK((files::read_text(folder.path() / "a.h5") != files::read_text(folder.path() / "b.h5")));
  CHECK(same_record(read_run_file(folder.path() / "b.h5").record, record));
}

TEST_CASE("Every truncation of a run file is refused by name") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.h5";
  write_run_file(file, example_record(), some_provenance);
  const std::string whole = files::read_text(file);
  for (const double share : {0.0, 0.001, 0.1, 0.5, 0.9, 0.999}) {
    files::write_text(
        file, whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    try {
      read_run_file(file);
      FAIL("a truncated file was read");
    } catch (const Error& error) {
      CHECK(error.kind() == Error::Kind::failed);
      CHECK_THAT(error.what(), Catch::Contains(file.string()));
    }
  }
}

TEST_CASE("A flipped bit is seen, or changes nothing") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.h5";
  auto record = example_record();
  record.series.back().values.resize(100);  // so that most flips hit metadata
  write_run_file(file, record, some_provenance);
  const std::string whole = files::read_text(file);
  std::mt19937 random(1);
  int seen = 0;
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << (random() % 8));
    std::ofstream(file, std::ios::binary) << damaged;
    std::optional<sweeps::store::RunFile> read;
    try {
      read = read_run_file(file);
    } catch (const Error&) {
      ++seen;
    }
    // Bytes that HDF5 leaves unused may differ.
    if (read) REQUIRE(same_record(read->record, record, /*timing_too=*/true));
  }
  CHECK(seen > trials / 2);
}

TEST_CASE("Damaged data are named with file and data set") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.h5";
  auto record = example_record();
  record.series.back().values.assign(100, 1234.5678);
  write_run_file(file, record, some_provenance);
  std::string bytes = files::read_text(file);
  const double value = 1234.5678;
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  REQUIRE(at != std::string::npos);
  bytes[at] ^= 1;
  files::write_text(file, bytes);
  CHECK_THROWS_WITH(read_run_file(file), Catch::Contains(file.string() + ":/series/base_power") &&
                                             Catch::Contains("checksum"));
}

TEST_CASE("Files of another kind or schema are refused as such") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.h5";
  const auto write_root = [&](std::string_view format, std::int64_t schema) {
    std::string image;
    {
      auto memory = sweeps::store::hdf5::File::create(file.string());
      memory.root().write_attribute("format", format);
      memory.root().write_attribute("schema", schema);
      image = std::move(memory).finish();
    }
    files::write_text(file, image);
  };
  write_root("shakebed run", sweeps::store::run_file_schema + 1);
  CHECK_THROWS_WITH(read_run_file(file), Catch::Contains(file.string()) &&
                                             Catch::Contains("another schema") &&
                                             Catch::Contains("expected schema 1, got 2"));
  write_root("somebody's data", 1);
  CHECK_THROWS_WITH(read_run_file(file), Catch::Contains("not a run file"));
  files::write_text(file, "W,T_z\n1,2\n");
  CHECK_THROWS_WITH(read_run_file(file), Catch::Contains(file.string()));
  CHECK_THROWS_WITH(read_run_file(folder.path() / "absent.h5"), Catch::Contains("absent.h5"));
}

TEST_CASE("A missing group or data set is named") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.h5";
  std::string image;
  {
    auto memory = sweeps::store::hdf5::File::create(file.string());
    memory.root().write_attribute("format", "shakebed run");
    memory.root().write_attribute("schema", std::int64_t{sweeps::store::run_file_schema});
    image = std::move(memory).finish();
  }
  files::write_text(file, image);
  CHECK_THROWS_WITH(read_run_file(file), Catch::Contains(file.string() + ":/scene"));
}

TEST_CASE("A record that cannot be stored leaves no file") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.h5";
  auto record = example_record();
  record.quantities.push_back({"T/m", "1", {1, 1}});
  CHECK_THROWS_WITH(write_run_file(file, record, {}), Catch::Contains("T/m"));
  record = example_record();
  record.quantities.push_back(record.quantities.front());
  CHECK_THROWS_WITH(write_run_file(file, record, {}), Catch::Contains("/averages/T_z"));
  record = example_record();
  record.profile.columns[0].mean.pop_back();
  CHECK_THROWS_WITH(write_run_file(file, record, {}), Catch::Contains("/profiles/phi"));
  CHECK(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace shakebed::tests
