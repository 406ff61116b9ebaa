#include <catch2/catch.hpp>

#include "simulator/motion/column/archive.hpp"
#include "tests/column/physics.hpp"

namespace {

using namespace shakebed::tests;

template <class Stepper>
std::string bytes_of(Stepper& bed) {
  ByteWriter writer;
  bed.archive(writer);
  return std::move(writer).take();
}

SizedGrains bed_of(int count) {
  auto grains = fill_column({3.0, count, 0.9, 1.1, true, 2.0, 7.09}, 5);
  for (double& v : grains.velocity[2]) v = -2;
  return grains;
}

LinearColumn physics() { return shaken(physics_of(table_grain, table_wall, 2e-4, 3.0), 1.5, 1.5); }

}  // namespace

TEST_CASE("A bed taken up from its checkpoint goes on bit for bit, from any step") {
  const auto start = bed_of(80);
  ColumnStepper<LinearColumn> bed(physics(), start);
  for (const long at : {1L, 777L, 4096L, 9001L}) {
    bed.advance(at - bed.step_number());
    const std::string saved = bytes_of(bed);
    ColumnStepper<LinearColumn> resumed(physics(), start);
    ByteReader reader(saved, "checkpoint");
    resumed.archive(reader);
    reader.finish();
    REQUIRE(resumed.step_number() == at);
    ColumnStepper<LinearColumn> original = bed;
    original.advance(1500);
    resumed.advance(1500);
    CHECK(bytes_of(original) == bytes_of(resumed));
  }
}

TEST_CASE("Looking at a bed does not change it") {
  ColumnStepper<LinearColumn> watched(physics(), bed_of(80));
  ColumnStepper<LinearColumn> alone(physics(), bed_of(80));
  for (int k = 0; k < 50; ++k) {
    watched.advance(101);
    watched.synchronised();
    watched.contacts();
  }
  alone.advance(5050);
  CHECK(bytes_of(watched) == bytes_of(alone));
}

TEST_CASE("A checkpoint that is cut short is refused") {
  ColumnStepper<LinearColumn> bed(physics(), bed_of(20));
  const std::string saved = bytes_of(bed);
  for (const std::size_t length : {std::size_t{0}, std::size_t{11}, saved.size() - 1}) {
    const std::string cut = saved.substr(0, length);
    ByteReader reader(cut, "bed.checkpoint");
    CHECK_THROWS_AS(bed.archive(reader), shakebed::files::Error);
  }
}
