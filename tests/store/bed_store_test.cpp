#include "sweeps/store/bed_store.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using shakebed::sweeps::store::bed_store;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("shakebed-beds-" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path only_file() const { return fs::directory_iterator(path / "beds")->path(); }
};

}  // namespace

TEST_CASE("Beds come back as they were given, by their whole name") {
  const Folder folder;
  const auto beds = bed_store(folder.path);
  CHECK_FALSE(beds.load("a"));
  const std::string bytes("\0\1 some\nbytes\xff", 14);
  beds.save("a", bytes);
  CHECK((beds.load("a") == bytes));
  CHECK_FALSE(beds.load("b"));
  beds.save("a", "");
  CHECK((beds.load("a") == std::string()));
  beds.forget("a");
  CHECK_FALSE(beds.load("a"));
  beds.forget("a");
}

TEST_CASE("A damaged bed counts as absent") {
  const Folder folder;
  const auto beds = bed_store(folder.path);
  beds.save("a", "twenty bytes of a bed");
  const auto size = fs::file_size(folder.only_file());
  SECTION("cut short") { fs::resize_file(folder.only_file(), size - 3); }
  SECTION("emptied") { fs::resize_file(folder.only_file(), 0); }
  SECTION("changed") {
    std::fstream file(folder.only_file(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(size - 1));
    file.put('X');
  }
  CHECK_FALSE(beds.load("a"));
  beds.save("a", "made again");
  CHECK((beds.load("a") == std::string("made again")));
}
