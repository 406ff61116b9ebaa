#include "sweeps/trade.hpp"

#include <algorithm>
#include <cmath>

#include "files/error.hpp"
#include "simulator/contact/parameters.hpp"

namespace shakebed::sweeps {
namespace {

using files::number_text;
using simulator::ContactOperator;
using simulator::Engine;
using simulator::Scene;

constexpr double reference_steps = 50;  // t_c/dt; the scene's default
constexpr double coarse_steps = 10;
constexpr double hardest = 30;  // times the scene's k_n

/// How precise quick is beside shipped.
constexpr double quick_loss = 6;
constexpr long quick_at_most = 600;

/// Every bias carries the error of what it is compared with.
void measure_twice_as_well(Scene& scene) {
  if (scene.protocol.until) scene.protocol.until->fraction /= 2;
  scene.protocol.at_most *= 4;
}

void set_steps(Scene& scene, double steps_in_contact) {
  scene.protocol.time_step_fraction = 1 / steps_in_contact;
}

void set_stiffness(Scene& scene, double factor) {
  scene.contact.stiffness = factor * bind_parameters(scene).stiffness;
}

/// Stiffness is kept: that of `auto` does not depend on the cell, but the text should not either.
void widen(Scene& scene, double factor) {
  double grains = scene.grains.count;
  for (double& width : scene.cell) {
    width *= factor;
    grains *= factor;
  }
  scene.grains.count = static_cast<int>(std::lround(grains));
}

/// A cell's width must hold a grain and its images, and a whole number of grains.
bool can_widen(const Scene& scene, double factor) {
  constexpr double narrowest = 2.2;
  double grains = scene.grains.count;
  for (const double width : scene.cell) {
    if (width * factor < narrowest) return false;
    grains *= factor;
  }
  return std::abs(grains - std::round(grains)) < 1e-6;
}

class Points {
 public:
  Points(Grid& grid, const Scene& base) : grid_(grid), base_(base) {}

  template <class Change>
  void add(const std::string& axis, double value, Change change) {
    Point point;
    point.labels = {axis, number_text(value)};
    point.scene = base_;
    change(point.scene);
    grid_.points.push_back(std::move(point));
  }

 private:
  Grid& grid_;
  const Scene& base_;
};

void add_settings(Grid& grid, const Scene& base, bool all) {
  using Values = std::vector<double>;
  const Values steps = all ? Values{5, 7, 10, 14, 20, 50} : Values{5, 10, 50};
  Points points(grid, base);
  points.add("reference", reference_steps, measure_twice_as_well);
  for (const double n : steps) {
    points.add("dt stepped", n, [n](Scene& scene) {
      scene.protocol.contacts = ContactOperator::fine;
      set_steps(scene, n);
    });
  }
  for (const double n : steps) {
    points.add("dt closed", n, [n](Scene& scene) { set_steps(scene, n); });
  }
  points.add("dt uniform", coarse_steps, [](Scene& scene) {
    scene.protocol.engine = Engine::uniform;
    scene.protocol.contacts = ContactOperator::automatic;
    set_steps(scene, coarse_steps);
  });
  for (const double factor :
       all ? Values{0.03, 0.1, 0.3, 1, 3, 10, hardest} : Values{0.1, 1, hardest}) {
    points.add("k_n", factor, [factor](Scene& scene) {
      set_stiffness(scene, factor);
      if (factor == hardest) measure_twice_as_well(scene);
    });
  }
  for (const double factor : {0.5, 2.0}) {
    if (!all || !can_widen(base, factor)) continue;
    points.add("cell", factor, [factor](Scene& scene) {
      set_stiffness(scene, 1);
      widen(scene, factor);
    });
  }
}

struct Mean {
  double value;
  double error;
};

Mean mean_of(const files::CsvTable& table, std::size_t row, const std::string& name) {
  return {table.number(row, table.column(name)), table.number(row, table.column(name + "_se"))};
}

/// 100 (x/x_0 - 1) and its standard error, the two being independent.
Mean bias_percent(const Mean& x, const Mean& reference) {
  const double ratio = x.value / reference.value;
  const double error =
      std::abs(ratio) * std::hypot(x.error / x.value, reference.error / reference.value);
  return {100 * (ratio - 1), 100 * error};
}

/// The row that an axis is compared with: the hardest grains for k_n, else the reference.
std::size_t compared_with(const Grid& grid, const std::string& axis) {
  if (axis != "k_n") return 0;
  std::size_t last = 0;  // k_n ascends
  for (std::size_t k = 0; k < grid.points.size(); ++k) {
    if (grid.points[k].labels[0] == "k_n") last = k;
  }
  return last;
}

const std::vector<std::string> observed{"T_z", "T_x", "h_cm"};

std::vector<files::CsvColumn> table_columns() {
  std::vector<files::CsvColumn> columns{{"scene", ""},      {"axis", ""},   {"value", "1"},
                                        {"dimension", "1"}, {"rough", "1"}, {"W", "1"},
                                        {"layers", "1"},    {"grains", "1"}};
  for (const auto& name : observed) {
    const std::string unit = name == "h_cm" ? "d" : "m g d";
    columns.push_back({name, unit});
    columns.push_back({name + "_se", unit});
  }
  columns.push_back({"T_z_scaled", "m V_p^2"});
  for (const auto& name : observed) {
    columns.push_back({name + "_bias", "%"});
    columns.push_back({name + "_bias_se", "%"});
  }
  columns.insert(columns.end(), {{"k_n", "m g/d"},
                                 {"largest_overlap", "d"},
                                 {"cycles", "1"},
                                 {"stationary", "1"},
                                 {"at_rest", "1"},
                                 {"seconds_per_1000_cycles", "s"},
                                 {"cycles_for_1_percent", "1"},
                                 {"seconds_for_1_percent", "s"},
                                 {"reason", ""}});
  return columns;
}

}  // namespace

TradeProfile trade_profile(const std::string& word) {
  if (word == "quick") return TradeProfile::quick;
  if (word == "shipped" || word == "paper") return TradeProfile::shipped;
  throw files::bad_input("--profile", "expected quick or shipped, got `" + word + "`");
}

Grid trade_grid(const std::filesystem::path& file, const std::vector<simulator::Override>& set,
                TradeProfile profile) {
  Scene base = simulator::read_scene(file, set);
  if (base.column || base.walled()) {
    throw files::bad_input(file.string(),
                           "a trade study compares engines and contact operators, which a bed with "
                           "a container, a lid or side walls has only one of; take a periodic bed");
  }
  base.protocol.engine = Engine::events;
  base.protocol.contacts = ContactOperator::closed;
  set_steps(base, reference_steps);
  const bool all = profile == TradeProfile::shipped;
  if (!all) {
    if (base.protocol.until) base.protocol.until->fraction *= quick_loss;
    base.protocol.at_most = std::min(base.protocol.at_most, quick_at_most);
  }
  Grid grid;
  grid.id = file.stem().string();
  grid.profile = all ? "shipped" : "quick";
  grid.columns = {{"axis", ""}, {"value", "1"}};
  grid.replicates = 1;
  add_settings(grid, base, all);
  return grid;
}

std::vector<double> time_in_turns(const std::vector<Scene>& scenes, int rounds,
                                  const Runner& runner) {
  constexpr double long_enough = 0.1;  // CPU seconds
  std::vector<long> cycles(scenes.size(), 40);
  std::vector<double> least(scenes.size(), INFINITY);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < scenes.size(); ++k) {
      Scene scene = scenes[k];
      scene.protocol.settle = 5;  // measured cycles are timed, and the transient forgets the start
      scene.protocol.until.reset();
      scene.protocol.cycles = cycles[k];
      const double seconds = runner(scene, {}).timing.cpu_seconds_measuring;
      least[k] = std::min(least[k], 1000 * seconds / static_cast<double>(cycles[k]));
      if (round == 0 && seconds < long_enough) {
        const double factor = std::min(50.0, long_enough / std::max(seconds, 1e-6));
        cycles[k] = std::lround(std::ceil(factor * static_cast<double>(cycles[k])));
      }
    }
  }
  for (double& seconds : least) {
    if (!std::isfinite(seconds)) seconds = std::nan("");
  }
  return least;
}

files::CsvTable trade_table(const std::string& scene, const Grid& grid,
                            const files::CsvTable& collected, const std::vector<double>& seconds) {
  files::CsvTable table(table_columns());
  for (std::size_t k = 0; k < grid.points.size(); ++k) {
    const Point& point = grid.points[k];
    const auto text = [&](const char* column) {
      return collected.text(k, collected.column(column));
    };
    const std::size_t reference = compared_with(grid, point.labels[0]);
    std::vector<std::string> row{scene,
                                 point.labels[0],
                                 point.labels[1],
                                 std::to_string(point.scene.dimension),
                                 bind_parameters(point.scene).turns_grains ? "1" : "0",
                                 text("W"),
                                 text("layers"),
                                 text("grains")};
    for (const auto& name : observed) {
      row.push_back(text(name.c_str()));
      row.push_back(text((name + "_se").c_str()));
    }
    row.push_back(text("T_z_scaled"));
    for (const auto& name : observed) {
      const Mean bias =
          bias_percent(mean_of(collected, k, name), mean_of(collected, reference, name));
      row.push_back(number_text(bias.value));
      row.push_back(number_text(k == reference ? std::nan("") : bias.error));
    }
    const Mean T_z = mean_of(collected, k, "T_z");
    const double cycles = collected.number(k, collected.column("cycles"));
    const double for_1_percent = cycles * std::pow(100 * T_z.error / T_z.value, 2);
    for (const char* name : {"k_n", "largest_overlap", "cycles", "stationary", "at_rest"}) {
      row.push_back(text(name));
    }
    row.push_back(number_text(seconds[k]));
    row.push_back(number_text(for_1_percent));
    row.push_back(number_text(1e-3 * for_1_percent * seconds[k]));
    row.push_back(text("reason"));
    table.add_row(std::move(row));
  }
  return table;
}

void append_rows(files::CsvTable& table, const files::CsvTable& more) {
  for (std::size_t row = 0; row < more.rows(); ++row) {
    std::vector<std::string> cells;
    for (std::size_t column = 0; column < more.columns().size(); ++column) {
      cells.push_back(more.text(row, column));
    }
    table.add_row(std::move(cells));
  }
}

}  // namespace shakebed::sweeps
