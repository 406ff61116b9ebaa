#include "sweeps/trade_column.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/contact/column_parameters.hpp"
#include "simulator/scene/read_scene.hpp"
#include "sweeps/trade.hpp"
#include "tests/sweeps/small_sweep.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::sweeps;

/// A small bed after Sun 2006, table I, in a file.
class ColumnFile {
 public:
  ColumnFile() {
    files::write_text(path(),
                      "scene: 1\n"
                      "dimension: 3\n"
                      "container: {cylinder: {diameter: 5}, wall: {gamma_t: 20}}\n"
                      "grains: {count: 60, friction: 0.5, large: {diameter: 2, density: 13.54}}\n"
                      "base: {drive: {frequency: 0.3, amplitude: 1}}\n"
                      "contact: {stiffness: 2e5, gamma_n: 40, tangential: {law: cundall_strack}}\n"
                      "protocol: {measure: {cycles: 2}}\n");
  }
  std::filesystem::path path() const { return folder_.path() / "column.yaml"; }

 private:
  tests::TemporaryFolder folder_;
};

TEST_CASE("A column's study changes one setting at a time and keeps restitution") {
  const ColumnFile file;
  const Grid grid = trade_grid(file.path(), {}, TradeProfile::shipped);
  CHECK(grid.replicates > 10);
  const auto scene = [&](const std::string& axis, const std::string& value) {
    for (const auto& point : grid.points) {
      if (point.labels == std::vector{axis, value}) return point.scene;
    }
    FAIL("no setting " << axis << " = " << value);
    return simulator::Scene();
  };
  const auto steps_of = [](const simulator::Scene& one) {
    const auto p = simulator::bind_column(one);
    return p.contact_duration / p.time_step;
  };
  CHECK(steps_of(scene("reference", "50")) == Approx(50).epsilon(0.02));
  CHECK(steps_of(scene("dt", "10")) == Approx(10).epsilon(0.02));
  // Steps a cycle are rounded to a multiple of 160.
  CHECK(steps_of(scene("k_n", "0.1")) == Approx(25).epsilon(0.04));
  CHECK_FALSE(scene("half step", "10").column->predict_velocities);
  CHECK(scene("list skin", "1").column->list_skin == 1);
  const auto usual = simulator::bind_column(scene("k_n", "1"));
  const auto soft = simulator::bind_column(scene("k_n", "0.1"));
  CHECK(soft.contact_duration == Approx(usual.contact_duration * std::sqrt(10.0)));
  for (std::size_t k = 0; k < usual.kinds.size(); ++k) {
    CHECK(soft.kinds[k].spring.normal_stiffness ==
          Approx(0.1 * usual.kinds[k].spring.normal_stiffness));
    CHECK(soft.kinds[k].restitution == Approx(usual.kinds[k].restitution));
  }
}

TEST_CASE("The rise rate is the slope of cycle means, whatever happens within a cycle") {
  simulator::Record record;
  std::vector<double> large, small;
  for (int cycle = 0; cycle < 4; ++cycle) {
    for (int phase = 0; phase < 10; ++phase) {
      const double wobble = std::sin(2 * M_PI * phase / 10);
      small.push_back(7 + 3 * wobble);
      large.push_back(7 + 1.5 * cycle - 2 * wobble);
    }
  }
  record.series = {{"large_height", "d", 0.1, large}, {"small_height", "d", 0.1, small}};
  CHECK(rise_rate(record) == Approx(1.5));
  record.series = {{"small_height", "d", 0.1, small}};
  CHECK(std::isnan(rise_rate(record)));
}

}  // namespace
