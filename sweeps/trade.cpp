#include "sweeps/trade.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "files/error.hpp"
#include "simulator/contact/parameters.hpp"
#include "sweeps/bias.hpp"
#include "sweeps/trade_column.hpp"
#include "sweeps/trade_parts.hpp"

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

constexpr int column_replicates = 16;

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

/// As many cycles as a grain thrown at V_p takes for so many flights.
void measure_flights(Scene& scene, double flights) {
  const double cycles = std::max(1.0, scene.flight_time() / scene.base.drive.period());
  scene.protocol.until.reset();
  scene.protocol.cycles = std::lround(std::ceil(flights * cycles));
}

/// Restitution at the base if its dashpot is that of two grains (c_n for m_eff = 1/2 in a contact
/// of m_eff = 1), for beta = -ln(e)/pi: exp(-pi beta/sqrt(2 + beta^2)). A program that knows one
/// c_n does that.
double restitution_with_pair_dashpot(double e_pair) {
  const double beta = -std::log(e_pair) / M_PI;
  return std::exp(-M_PI * beta / std::sqrt(2 + beta * beta));
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

void add_settings(Grid& grid, const Scene& base, bool all) {
  using Values = std::vector<double>;
  const Values steps = all ? Values{5, 7, 10, 14, 20, 50} : Values{5, 10, 50};
  TradePoints points(grid, base);
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
  for (const double flights : all ? Values{30, 120, 480} : Values{30}) {
    points.add("cycles", flights, [flights](Scene& scene) { measure_flights(scene, flights); });
  }
  for (const double number : all ? Values{1, 4, 16} : Values{4}) {
    constexpr double total_flights = 480;
    points.add("replicates", number, [number, all](Scene& scene) {
      measure_flights(scene, total_flights / number / (all ? 1 : 4));
    });
    grid.points.back().replicates = static_cast<int>(number);
  }
  const double e_w = restitution_with_pair_dashpot(base.grains.restitution);
  points.add("pair dashpot at base", e_w, [e_w](Scene& scene) { scene.base.restitution = e_w; });
  for (const double factor : {0.5, 2.0}) {
    if (!all || !can_widen(base, factor)) continue;
    points.add("cell", factor, [factor](Scene& scene) {
      set_stiffness(scene, 1);
      widen(scene, factor);
    });
  }
}

simulator::Estimate mean_of(const files::CsvTable& table, std::size_t row,
                            const std::string& name) {
  return {table.number(row, table.column(name)), table.number(row, table.column(name + "_se"))};
}

const std::vector<std::string> observed{"T_z", "T_x", "h_cm"};

std::vector<files::CsvColumn> table_columns() {
  std::vector<files::CsvColumn> columns{
      {"scene", ""}, {"axis", ""},    {"value", "1"},  {"dimension", "1"},   {"rough", "1"},
      {"W", "1"},    {"layers", "1"}, {"grains", "1"}, {"restitution", "1"}, {"amplitude", "d"}};
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

/// What a trade study of a periodic bed changes its settings from.
Scene with_defaults(Scene base, const std::filesystem::path& file, bool all) {
  if (base.walled()) {
    throw files::bad_input(file.string(),
                           "a trade study compares engines and contact operators, which a bed with "
                           "a lid or side walls has only one of; take a periodic bed");
  }
  base.protocol.engine = Engine::events;
  base.protocol.contacts = ContactOperator::closed;
  set_steps(base, reference_steps);
  if (!all) {
    if (base.protocol.until) base.protocol.until->fraction *= quick_loss;
    base.protocol.at_most = std::min(base.protocol.at_most, quick_at_most);
  }
  return base;
}

}  // namespace

TradeProfile trade_profile(const std::string& word) {
  if (word == "quick") return TradeProfile::quick;
  if (word == "shipped" || word == "paper") return TradeProfile::shipped;
  throw files::bad_input("--profile", "expected quick or shipped, got `" + word + "`");
}

namespace {

files::Error no_such_axis(const std::string& axis, const Grid& grid,
                          const std::set<std::string>& known) {
  std::string names;
  for (const auto& name : known) {
    if (!names.empty()) names += ", ";
    names.append("`").append(name).append("`");
  }
  return files::bad_input("--axis", "no axis `" + axis + "` in a study of " + grid.id +
                                        " (profile " + grid.profile + "); it has " + names);
}

}  // namespace

void keep_axes(Grid& grid, const std::vector<std::string>& axes) {
  std::set<std::string> known;
  for (const auto& point : grid.points) known.insert(point.labels[0]);
  for (const auto& axis : axes) {
    if (!known.contains(axis)) throw no_such_axis(axis, grid, known);
  }
  std::erase_if(grid.points, [&](const Point& point) {
    const auto& axis = point.labels[0];
    return axis != "reference" && std::find(axes.begin(), axes.end(), axis) == axes.end();
  });
}

Grid trade_grid(const std::filesystem::path& file, const std::vector<simulator::Override>& set,
                TradeProfile profile) {
  const Scene base = simulator::read_scene(file, set);
  const bool all = profile == TradeProfile::shipped;
  Grid grid;
  grid.id = file.stem().string();
  grid.profile = all ? "shipped" : "quick";
  grid.columns = {{"axis", ""}, {"value", "1"}};
  if (base.column) {
    grid.replicates = all ? column_replicates : 2;
    add_column_settings(grid, base, all);
  } else {
    add_settings(grid, with_defaults(base, file, all), all);
  }
  return grid;
}

std::vector<double> time_in_turns(const std::vector<Scene>& scenes, int rounds,
                                  const Runner& runner) {
  constexpr double long_enough = 0.1;  // CPU seconds
  const bool column = !scenes.empty() && scenes.front().column;
  std::vector<long> cycles(scenes.size(), column ? 2 : 40);
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
                                 text("grains"),
                                 number_text(point.scene.least_restitution()),
                                 number_text(point.scene.base.drive.amplitude)};
    for (const auto& name : observed) {
      row.push_back(text(name.c_str()));
      row.push_back(text((name + "_se").c_str()));
    }
    row.push_back(text("T_z_scaled"));
    for (const auto& name : observed) {
      const auto bias =
          bias_percent(mean_of(collected, k, name), mean_of(collected, reference, name));
      row.push_back(number_text(bias.mean));
      row.push_back(number_text(k == reference ? std::nan("") : bias.standard_error));
    }
    const auto T_z = mean_of(collected, k, "T_z");
    const double cycles = collected.number(k, collected.column("cycles"));
    const double for_1_percent = cycles * std::pow(100 * T_z.standard_error / T_z.mean, 2);
    // Several short runs pay for a transient each; elsewhere it is left out, as runs are long.
    double transients = 0;
    if (point.replicates > 0) {
      transients = point.replicates * collected.number(k, collected.column("transient")) / cycles;
    }
    for (const char* name : {"k_n", "largest_overlap", "cycles", "stationary", "at_rest"}) {
      row.push_back(text(name));
    }
    row.push_back(number_text(seconds[k]));
    row.push_back(number_text(for_1_percent));
    row.push_back(number_text(1e-3 * for_1_percent * (1 + transients) * seconds[k]));
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
