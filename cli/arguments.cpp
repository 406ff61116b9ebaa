#include "cli/arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/version_text.hpp"
#include "files/error.hpp"
#include "files/yaml.hpp"

namespace shakebed::cli {
namespace {

constexpr const char* about =
    "Simulates vertically shaken granular beds (DEM) and carries the results to fits and "
    "figures.\nExit codes: 0 fine, 1 the work could not be done, 2 bad input or usage, 130 "
    "interrupted.";

constexpr const char* set_help =
    "Override any key of the scene: --set base.drive.W=30; repeat for more.\n"
    "Setting one of the equivalent drive keys replaces the other: a rate (W,\n"
    "Gamma, frequency, angular_frequency, frequency_rpm, frequency_hz) replaces\n"
    "the scene's rate and keeps its amplitude, an amplitude keeps its rate, and\n"
    "two drive keys set replace both. layers and count replace each other, and\n"
    "so do measure.cycles and measure.until.";

/// Every subcommand fills its options and, when it is the one called, sets what to do.
using Action = std::function<int()>;

/// The options live as long as the parser, which writes into them.
template <class Options>
std::shared_ptr<Options> options_of(CLI::App* command, Action& action,
                                    int (*function)(const Options&)) {
  auto options = std::make_shared<Options>();
  command->callback([options, &action, function] {
    action = [options, function] { return function(*options); };
  });
  return options;
}

/// `--set` takes one value at a time, so that a scene may follow it.
void add_set(CLI::App* command, std::vector<std::string>& set) {
  command->add_option("--set", set, set_help)->type_name("KEY=VALUE")->allow_extra_args(false);
}

void add_cache(CLI::App* command, std::optional<std::filesystem::path>& cache) {
  command
      ->add_option("--cache", cache,
                   "Folder of finished runs; else $SHAKEBED_CACHE, else build/cache")
      ->type_name("DIR");
}

void add_jobs(CLI::App* command, int& jobs) {
  command->add_option("--jobs", jobs, "Cores, one a bed; 0: all there are")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str()
      ->type_name("N");
}

void add_run(CLI::App& app, Action& action) {
  auto* run = app.add_subcommand("run", "Simulate one bed and report its averages");
  auto options = options_of(run, action, &run_command);
  run->add_option("SCENE", options->scene, "Scene (YAML)")->required()->type_name("FILE");
  add_set(run, options->set);
  run->add_option("--output", options->output, "Write the run file (HDF5) here")->type_name("FILE");
  run->add_option("--json", options->json, "Write the averages as JSON here; - is standard output")
      ->type_name("FILE|-");
  run->add_option("--threads", options->threads, "For one bed in a container; 0: one a core")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
}

void add_check(CLI::App& app, Action& action) {
  auto* check = app.add_subcommand(
      "check", "Say what a scene makes the program model, how finely and at what cost");
  auto options = options_of(check, action, &check_command);
  auto* scene = check->add_option("SCENE", options->scene, "Scene (YAML)")->type_name("FILE");
  add_set(check, options->set);
  check
      ->add_option("--csv", options->csv,
                   "Write the contacts of a bed in a container here too, one row a kind")
      ->type_name("FILE");
  auto* keys = check->add_flag("--keys", options->keys, "Print every key a scene may have instead");
  auto* schema = check->add_flag("--schema", options->schema,
                                 "Print the JSON schema of scenes instead, for editors");
  keys->excludes(schema);
  check
      ->add_flag("--accuracy", options->accuracy,
                 "Print what `accuracy` promises and the settings it chooses instead")
      ->excludes(keys)
      ->excludes(schema);
  check->parse_complete_callback([scene, options] {
    if (scene->count() == 0 && !options->keys && !options->schema && !options->accuracy) {
      throw CLI::RequiredError("SCENE (or one of --keys, --schema, --accuracy)");
    }
  });
}

void add_sweep_arguments(CLI::App* command, SweepOptions& options) {
  command->add_option("SWEEP", options.sweep, "Sweep (YAML)")->required()->type_name("FILE");
  command
      ->add_option("--profile", options.profile,
                   "Profile of the sweep: quick shows the shape, paper has every printed point, "
                   "shipped is what data/ holds")
      ->capture_default_str()
      ->type_name("NAME");
  add_cache(command, options.cache);
}

void add_csv(CLI::App* command, SweepOptions& options) {
  command->add_option("--csv", options.csv, "Write the table here, not to standard output")
      ->type_name("FILE");
}

void add_sweep_networks(CLI::App& sweep, Action& action) {
  auto* networks = sweep.add_subcommand(
      "networks", "Force networks and spanning trees of the snapshots: mean and spread");
  auto options = options_of(networks, action, &sweep_networks_command);
  add_sweep_arguments(networks, *options);
  networks
      ->add_option("--reference", options->reference,
                   "Numbers to set beside ours (CSV): quantity, paper, source, columns of axes")
      ->type_name("FILE");
  networks->add_option("--csv-folder", options->csv_folder, "Write the tables into this folder")
      ->required()
      ->type_name("DIR");
}

void add_sweep(CLI::App& app, Action& action) {
  auto* sweep = app.add_subcommand("sweep", "Run, watch or collect a grid of beds");
  sweep->require_subcommand(1);

  auto* run = sweep->add_subcommand(
      "run", "Simulate every point that is not cached; Ctrl-C and the same command resume");
  auto run_options = options_of(run, action, &sweep_run_command);
  add_sweep_arguments(run, *run_options);
  add_jobs(run, run_options->jobs);

  auto* status = sweep->add_subcommand("status", "Say which points are finished");
  add_sweep_arguments(status, *options_of(status, action, &sweep_status_command));

  auto* collect = sweep->add_subcommand(
      "collect", "One row a point: means and standard errors over its replicates");
  auto collect_options = options_of(collect, action, &sweep_collect_command);
  add_sweep_arguments(collect, *collect_options);
  add_csv(collect, *collect_options);
  collect
      ->add_option("--profiles", collect_options->profiles,
                   "Write the height profiles here, one row a box of each point")
      ->type_name("FILE");

  auto* snapshots = sweep->add_subcommand(
      "snapshots", "One row a grain of every snapshot that the points' scenes ask for");
  auto snapshot_options = options_of(snapshots, action, &sweep_snapshots_command);
  add_sweep_arguments(snapshots, *snapshot_options);
  add_csv(snapshots, *snapshot_options);

  auto* series = sweep->add_subcommand(
      "series", "One row an instant of every run: how beds in containers go within their cycles");
  auto series_options = options_of(series, action, &sweep_series_command);
  add_sweep_arguments(series, *series_options);
  add_csv(series, *series_options);
  series->add_option("--phases", series_options->phases, "Equal phases of each cycle, of 160")
      ->check(CLI::Range(1, 160))
      ->capture_default_str()
      ->type_name("N");
  series->add_option("--from", series_options->from, "First cycle")->type_name("T");
  series->add_option("--to", series_options->to, "Last cycle")->type_name("T");
  add_sweep_networks(*sweep, action);
}

void add_trade(CLI::App& app, Action& action) {
  auto* trade = app.add_subcommand(
      "trade", "What accuracy costs: bias and CPU time of a bed under every numerical setting");
  auto options = options_of(trade, action, &trade_command);
  auto* scenes = trade->add_option("SCENE", options->scenes, "Scenes (YAML); one table for all");
  scenes->type_name("FILE");
  add_set(trade, options->set);
  trade
      ->add_option("--profile", options->profile,
                   "quick: few settings, rough errors; shipped: all, as long as the scene measures")
      ->capture_default_str()
      ->type_name("NAME");
  trade
      ->add_option(
          "--axis", options->axes,
          "Only this axis beside the reference, such as k_n or replicates; repeat for more")
      ->type_name("NAME")
      ->allow_extra_args(false);
  add_cache(trade, options->cache);
  add_jobs(trade, options->jobs);
  trade
      ->add_option("--rounds", options->rounds,
                   "Rounds of timing; all settings are timed once in each, and the least counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str()
      ->type_name("N");
  trade->add_option("--csv", options->csv, "Write the table here")->type_name("FILE");
  auto* bounds = trade->add_option("--bounds", options->bounds,
                                   "Run nothing: from such a table, the settings that `accuracy` "
                                   "chooses from, with bounds on their bias");
  bounds->type_name("FILE")->excludes(scenes);
  trade->add_option("--laws", options->laws, "With --bounds: write each scene's bias law here")
      ->type_name("FILE")
      ->needs(bounds);
  trade->add_option("--alpha", options->alpha,
                    "With --bounds: write the exponent alpha at each setting here");
  auto* verify = trade->add_option("--verify", options->verify,
                                   "Run nothing: how many runs of this table (scene, asked, T_z) "
                                   "kept their promise");
  verify->type_name("FILE")->excludes(scenes)->excludes(bounds);
  auto* references = trade->add_option("--references", options->references,
                                       "With --verify: the same scenes, converged");
  references->type_name("FILE")->needs(verify);
  verify->needs(references);
  trade->parse_complete_callback([scenes, bounds, verify] {
    if (scenes->count() + bounds->count() + verify->count() == 0) {
      throw CLI::RequiredError("SCENE (or --bounds, --verify)");
    }
  });
}

void add_extremes(CLI::App& app, Action& action) {
  auto* extremes = app.add_subcommand(
      "extremes", "Run a list of extreme scenes: which are right, which say that they are not");
  auto options = options_of(extremes, action, &extremes_command);
  extremes->add_option("LIST", options->list, "List of scenes (YAML)")
      ->required()
      ->type_name("FILE");
  add_cache(extremes, options->cache);
  add_jobs(extremes, options->jobs);
  extremes->add_option("--csv", options->csv, "Write the table here")->type_name("FILE");
}

void add_fit(CLI::App& app, Action& action) {
  auto* fit = app.add_subcommand("fit", "Fit a model to a collected table; never runs a bed");
  auto options = options_of(fit, action, &fit_command);
  fit->add_option("FIT", options->fit, "Fit (YAML)")->required()->type_name("FILE");
  fit->add_option("--data", options->data, "Use this table (CSV) in place of the fit's own")
      ->type_name("FILE");
  fit->add_option("--csv", options->csv, "Write the parameters here and the other tables beside it")
      ->type_name("FILE");
}

void add_figure(CLI::App& app, Action& action) {
  auto* figure = app.add_subcommand("figure", "Draw a figure from tables; never computes");
  auto options = options_of(figure, action, &figure_command);
  figure->add_option("ID", options->id, "Such as bhateja2016-fig02")->required();
  figure->add_option("--spec", options->specification, "Figure specification (YAML)")
      ->required()
      ->type_name("FILE");
  figure->add_option("--table", options->tables, "A table (CSV) to draw; repeat for more")
      ->allow_extra_args(false)
      ->type_name("FILE");
  figure->add_option("--output", options->output_folder, "Folder for CSV, SVG and PNG")
      ->required()
      ->type_name("DIR");
}

void add_claims(CLI::App& app, Action& action) {
  auto* claims = app.add_subcommand(
      "claims", "The papers' claims: our number, its error and a verdict for each");
  auto options = options_of(claims, action, &claims_command);
  claims->add_option("MANIFEST", options->manifest, "data_manifest.yaml")
      ->required()
      ->type_name("FILE");
  claims->add_option("--tables", options->tables, "tables.csv of a build folder")
      ->required()
      ->type_name("FILE");
  claims->add_option("--csv", options->csv, "Write all of it here")->type_name("FILE");
  claims->add_option("--recorded", options->recorded, "Name the verdicts that differ from these")
      ->type_name("FILE");
  claims->add_option("--record", options->record, "Write the verdicts from shipped averages here")
      ->type_name("FILE");
}

void add_network(CLI::App& app, Action& action) {
  auto* network = app.add_subcommand(
      "network", "Force networks, force statistics and spanning trees of one snapshot");
  auto options = options_of(network, action, &network_command);
  auto* snapshot =
      network->add_option("SNAPSHOT", options->snapshot, "Snapshot (HDF5): run.h5, or run.h5:NAME");
  snapshot->type_name("FILE");
  auto* grains = network->add_option("--grains", options->grains,
                                     "Grains (CSV): id, x, y, z, radius; needs --contacts");
  grains->type_name("FILE")->excludes(snapshot);
  auto* contacts = network->add_option(
      "--contacts", options->contacts,
      "Contacts (CSV): i, j, normal_force; an empty j is a wall; needs --grains");
  contacts->type_name("FILE")->needs(grains);
  grains->needs(contacts);
  network->add_option("--passes", options->passes, "Passes of the spanning tree")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->type_name("N");
  network->add_option("--elongation", options->elongation, "Factor on edges of earlier passes")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str()
      ->type_name("X");
  network->add_option("--force-bin", options->force_bin, "Bin of f = Fn / mean(Fn)")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->type_name("X");
  network
      ->add_option("--correlation-bin", options->correlation_bin,
                   "Bin of F(r) [median grain diameter]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->type_name("X");
  network
      ->add_option("--correlation-reach", options->correlation_reach,
                   "Largest r of F(r) [median grain diameter]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->type_name("X");
  network->add_option("--json", options->json, "Write the results as JSON; - is standard output")
      ->type_name("FILE|-");
  network
      ->add_option("--csv-folder,--csv", options->csv_folder, "Write the tables into this folder")
      ->type_name("DIR");
  network->parse_complete_callback([snapshot, grains] {
    if (snapshot->count() + grains->count() == 0) {
      throw CLI::RequiredError("SNAPSHOT (or --grains with --contacts)");
    }
  });
}

void add_export(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("export", "Write a scene for another code");
  auto options = options_of(command, action, &export_command);
  command->add_option("SCENE", options->scene, "Scene (YAML)")->required()->type_name("FILE");
  add_set(command, options->set);
  command->add_option("--format", options->format, "Which code: lammps-deck")
      ->check(CLI::IsMember({"lammps-deck"}))
      ->capture_default_str()
      ->type_name("FORMAT");
  command->add_option("--output", options->output, "Write here, not to standard output")
      ->type_name("FILE");
}

/// CLI11 alone would only say that a subcommand is required.
std::string unknown_subcommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const auto* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (word.starts_with('-') || std::find(known.begin(), known.end(), word) != known.end())
    return "";
  std::string text = "unknown subcommand `" + word + "`";
  if (const auto near = files::nearest_word(word, known)) {
    return text + "; did you mean `" + *near + "`?";
  }
  text += "; known:";
  for (const auto& command : known) text += " " + command;
  return text;
}

std::string failure_text(const CLI::App* /*app*/, const CLI::Error& error) {
  return "shakebed: error: " + std::string(error.what()) +
         "\nRun it with --help for more information.\n";
}

}  // namespace

int dispatch(int argc, char** argv) {
  CLI::App app(about, "shakebed");
  app.set_version_flag("--version", version_text(), "Print version, revision and build");
  app.require_subcommand(1);
  app.failure_message(failure_text);
  Action action;
  add_run(app, action);
  add_check(app, action);
  add_sweep(app, action);
  add_trade(app, action);
  add_extremes(app, action);
  add_fit(app, action);
  add_figure(app, action);
  add_claims(app, action);
  add_network(app, action);
  add_export(app, action);
  if (const auto fault = argc > 1 ? unknown_subcommand(app, argv[1]) : ""; !fault.empty()) {
    throw files::bad_input("", fault);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 has a code for every kind of fault; a user needs to know only that it was the usage.
    return app.exit(error, std::cout, std::cerr) == 0 ? 0 : 2;
  }
  return action();
}

}  // namespace shakebed::cli
