#include "sweeps/progress.hpp"

#include <catch2/catch.hpp>
#include <sstream>

namespace shakebed::tests {
namespace {

using sweeps::Progress;

std::size_t count(const std::string& text, char wanted) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), wanted));
}

TEST_CASE("Time left is weighted by predicted cost") {
  std::ostringstream text;
  double now = 100;
  Progress progress(text, false, "sweep", [&] { return now; });
  progress.begin(10, 200);
  now += 30;
  progress.advance(50);  // a quarter of the cost in 30 s: 90 s are left, whatever the bed count
  CHECK(text.str() == "sweep: 0 of 10 beds, 25 %, 0:30 gone, about 1:30 to go\n");
}

TEST_CASE("Elsewhere than on a terminal lines come every ten seconds or ten per cent") {
  std::ostringstream text;
  double now = 0;
  Progress progress(text, false, "sweep", [&] { return now; });
  progress.begin(1000, 1000);
  for (int bed = 0; bed < 1000; ++bed) {
    now += 0.15;  // 150 s in all: ten per cent take 15 s, so ten seconds come first
    progress.advance(1);
    progress.finish_run();
  }
  progress.end();
  const auto lines = count(text.str(), '\n');
  CHECK(lines >= 14);
  CHECK(lines <= 26);
  CHECK(text.str().find('\r') == std::string::npos);
  CHECK_THAT(text.str(), Catch::EndsWith("1000 of 1000 beds, 100 %, 2:30 gone\n"));
}

TEST_CASE("A short ensemble says little") {
  std::ostringstream text;
  double now = 0;
  Progress progress(text, false, "sweep", [&] { return now; });
  progress.begin(100, 100);
  for (int bed = 0; bed < 100; ++bed) {
    now += 0.001;
    progress.advance(1);
    progress.finish_run();
  }
  progress.end();
  CHECK(count(text.str(), '\n') == 1);
}

TEST_CASE("On a terminal one line is kept up to date") {
  std::ostringstream text;
  double now = 0;
  Progress progress(text, true, "sweep", [&] { return now; });
  progress.begin(100, 100);
  for (int bed = 0; bed < 100; ++bed) {
    now += 0.1;
    progress.advance(1);
    progress.finish_run();
  }
  progress.end();
  CHECK(count(text.str(), '\n') == 1);
  CHECK(count(text.str(), '\r') >= 30);
  CHECK(count(text.str(), '\r') <= 60);
}

TEST_CASE("Times read as a clock") {
  CHECK(sweeps::clock_text(7.4) == "0:07");
  CHECK(sweeps::clock_text(754) == "12:34");
  CHECK(sweeps::clock_text(3723) == "1:02:03");
  CHECK(sweeps::clock_text(-1) == "0:00");
}

}  // namespace
}  // namespace shakebed::tests
