#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// One plain options struct and one function per subcommand. arguments.cpp fills the structs (the
// only file that includes CLI11); each subcommand has a file of its own; all of them throw
// files::Error, and only main turns that into an exit code.
namespace shakebed::cli {

struct RunOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;                 ///< "base.drive.W=30"
  std::optional<std::filesystem::path> output;  ///< run file (HDF5)
  std::optional<std::string> json;              ///< path, or "-" for standard output
  int threads = 0;                              ///< 0: one a core
};
int run_command(const RunOptions& options);

struct CheckOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;
  bool keys = false;                         ///< print the table of scene keys instead
  bool schema = false;                       ///< print the JSON schema instead
  std::optional<std::filesystem::path> csv;  ///< a container's contacts by kind go here too
  bool accuracy = false;                     ///< print what `accuracy` promises instead
};
int check_command(const CheckOptions& options);

struct SweepOptions {
  std::filesystem::path sweep;
  std::string profile = "quick";
  std::optional<std::filesystem::path> cache;  ///< else SHAKEBED_CACHE, else build/cache
  int jobs = 0;                                ///< 0: all cores
  std::optional<std::filesystem::path> csv;    ///< collect, snapshots: file; else standard output
  std::optional<std::filesystem::path> profiles;    ///< collect: height profiles, a row a box
  int phases = 20;                                  ///< series: of each cycle
  double from = 0;                                  ///< series [cycles]
  double to = 1e9;                                  ///< series [cycles]
  std::optional<std::filesystem::path> reference;   ///< networks: a paper's numbers
  std::optional<std::filesystem::path> csv_folder;  ///< networks: where its tables go
};
int sweep_run_command(const SweepOptions& options);
int sweep_status_command(const SweepOptions& options);
int sweep_collect_command(const SweepOptions& options);
int sweep_snapshots_command(const SweepOptions& options);
int sweep_series_command(const SweepOptions& options);
int sweep_networks_command(const SweepOptions& options);

struct TradeOptions {
  std::vector<std::filesystem::path> scenes;
  std::vector<std::string> set;
  std::string profile = "quick";
  std::vector<std::string> axes;                    ///< empty: all
  std::optional<std::filesystem::path> cache;       ///< else SHAKEBED_CACHE, else build/cache
  int jobs = 0;                                     ///< 0: all cores
  int rounds = 3;                                   ///< of timing
  std::optional<std::filesystem::path> bounds;      ///< compute bounds from this table instead
  std::optional<std::filesystem::path> verify;      ///< runs whose promises to check instead
  std::optional<std::filesystem::path> references;  ///< with `verify`
  std::optional<std::filesystem::path> laws;        ///< with `bounds`: the bias laws go here
  std::optional<std::filesystem::path> alpha;       ///< with `bounds`: exponents by setting go here
  std::optional<std::filesystem::path> csv;
};
int trade_command(const TradeOptions& options);

struct ExtremesOptions {
  std::filesystem::path list;
  std::optional<std::filesystem::path> cache;  ///< else SHAKEBED_CACHE, else build/cache
  int jobs = 0;                                ///< 0: all cores
  std::optional<std::filesystem::path> csv;
};
int extremes_command(const ExtremesOptions& options);

struct FitOptions {
  std::filesystem::path fit;
  std::optional<std::filesystem::path> data;  ///< overrides the fit file's table
  /// Parameters; the other tables go beside it (fitting/tables.hpp: table_path).
  std::optional<std::filesystem::path> csv;
};
int fit_command(const FitOptions& options);

struct FigureOptions {
  std::string id;  ///< "bhateja2016-fig02"
  std::filesystem::path specification;
  std::vector<std::filesystem::path> tables;
  std::filesystem::path output_folder;
};
int figure_command(const FigureOptions& options);

struct ClaimsOptions {
  std::filesystem::path manifest;
  std::filesystem::path tables;                   ///< tables.csv of a build folder
  std::optional<std::filesystem::path> csv;       ///< every claim over every origin
  std::optional<std::filesystem::path> recorded;  ///< verdicts to compare with
  std::optional<std::filesystem::path> record;    ///< write the shipped verdicts here
};
int claims_command(const ClaimsOptions& options);

struct ExportOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;
  std::string format = "lammps-deck";
  std::optional<std::filesystem::path> output;
};
int export_command(const ExportOptions& options);

struct NetworkOptions {
  std::optional<std::filesystem::path> snapshot;
  std::optional<std::filesystem::path> grains;
  std::optional<std::filesystem::path> contacts;
  int passes = 5;
  double elongation = 1.2;
  double force_bin = 0.1;        ///< of f = F_n / mean(F_n)
  double correlation_bin = 0.1;  ///< of r [median grain diameter]
  double correlation_reach = 6;  ///< largest r [median grain diameter]
  std::optional<std::string> json;
  std::optional<std::filesystem::path> csv_folder;
};
int network_command(const NetworkOptions& options);

}  // namespace shakebed::cli
