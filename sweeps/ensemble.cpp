#include "sweeps/ensemble.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <set>

#include "files/error.hpp"
#include "sweeps/cost_model.hpp"
#include "sweeps/store/bed_store.hpp"
#include "sweeps/thread_team.hpp"

namespace shakebed::sweeps {
namespace {

using simulator::Record;

/// A bed to simulate and what it is likely to cost.
struct Task {
  std::size_t run;
  double predicted_cost;
};

/// What a worker hands to the writer.
struct Outcome {
  Task task{};
  std::optional<Record> record;
  std::optional<std::string> failure;
};

std::vector<Task> missing_runs(const std::vector<Run>& runs, const store::Cache& cache,
                               EnsembleReport& report) {
  std::vector<Task> tasks;
  std::set<std::string> wanted;  // points of a grid may coincide
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!wanted.insert(runs[k].identity.key).second) continue;
    const auto found = cache.find(runs[k].identity);
    if (found.run) {
      ++report.cached;
      continue;
    }
    if (!found.problem.empty()) report.made_again.push_back(found.problem);
    tasks.push_back({k, predicted_cpu_seconds(runs[k].scene)});
  }
  std::stable_sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) {
    return a.predicted_cost > b.predicted_cost;
  });
  return tasks;
}

class Ensemble {
 public:
  Ensemble(const std::vector<Run>& runs, const store::Cache& cache, const Runner& runner,
           const EnsembleOptions& options, EnsembleReport& report)
      : runs_(runs), cache_(cache), runner_(runner), options_(options), report_(report) {}

  /// The pipeline's token limit is what keeps the number of living records at `jobs`; its last
  /// stage is the one writer.
  void run(const std::vector<Task>& tasks, int jobs) {
    threads_per_bed_ = std::max(1, jobs / static_cast<int>(tasks.size()));
    std::size_t next = 0;
    const auto hand_out = [&](tbb::flow_control& control) {
      if (next == tasks.size() || stop_requested()) {
        control.stop();
        return Task{};
      }
      return tasks[next++];
    };
    tbb::parallel_pipeline(
        static_cast<std::size_t>(jobs),
        tbb::make_filter<void, Task>(tbb::filter_mode::serial_in_order, hand_out) &
            tbb::make_filter<Task, Outcome>(tbb::filter_mode::parallel,
                                            [&](const Task& task) { return simulate(task); }) &
            tbb::make_filter<Outcome, void>(tbb::filter_mode::serial_out_of_order,
                                            [&](const Outcome& outcome) { keep(outcome); }));
    report_.interrupted = report_.interrupted || next < tasks.size();
    std::sort(report_.failures.begin(), report_.failures.end(),
              [](const RunFailure& a, const RunFailure& b) { return a.run < b.run; });
  }

 private:
  bool stop_requested() const {
    return cannot_write_ || (options_.stop_requested && options_.stop_requested());
  }

  Outcome simulate(const Task& task) const {
    Outcome outcome;
    outcome.task = task;
    double shown = 0;
    const auto advance_to = [&](double share) {
      if (options_.progress == nullptr || share <= shown) return;
      options_.progress->advance(task.predicted_cost * (share - shown));
      shown = share;
    };
    try {
      const auto& scene = runs_[task.run].scene;
      auto team = ThreadTeam::for_bed(scene, threads_per_bed_);
      outcome.record =
          runner_(scene, {[this] { return stop_requested(); }, advance_to, &beds_, &team});
    } catch (const files::Interrupted&) {
      return outcome;
    } catch (const std::exception& error) {
      outcome.failure = error.what();
    }
    advance_to(1);
    return outcome;
  }

  void keep(const Outcome& outcome) {
    try {
      write(outcome);
    } catch (...) {
      cannot_write_ = true;  // so that the beds under way do not work for nothing
      throw;
    }
  }

  void write(const Outcome& outcome) {
    const Run& run = runs_[outcome.task.run];
    if (outcome.record) {
      cache_.put(run.identity, *outcome.record, provenance_);
      ++report_.finished;
    } else if (outcome.failure) {
      cache_.note_failure(run.identity, *outcome.failure);
      report_.failures.push_back({outcome.task.run, *outcome.failure});
    } else {
      report_.interrupted = true;
      return;
    }
    if (options_.progress != nullptr) options_.progress->finish_run();
  }

  const std::vector<Run>& runs_;
  const store::Cache& cache_;
  const Runner& runner_;
  const EnsembleOptions& options_;
  EnsembleReport& report_;
  int threads_per_bed_ = 1;
  std::atomic<bool> cannot_write_ = false;
  const simulator::BedStore beds_ = store::bed_store(cache_.folder());
  const store::Provenance provenance_ = store::provenance_of_this_program();
};

/// Begins the display, and ends it also when the ensemble throws.
class Shown {
 public:
  Shown(Progress* progress, const std::vector<Task>& tasks) : progress_(progress) {
    if (progress_ == nullptr) return;
    double predicted = 0;
    for (const auto& task : tasks) predicted += task.predicted_cost;
    progress_->begin(tasks.size(), predicted);
  }
  ~Shown() {
    if (progress_ != nullptr) progress_->end();
  }
  Shown(const Shown&) = delete;
  Shown& operator=(const Shown&) = delete;

 private:
  Progress* progress_;
};

}  // namespace

EnsembleReport run_ensemble(const std::vector<Run>& runs, const store::Cache& cache,
                            const Runner& runner, const EnsembleOptions& options) {
  EnsembleReport report;
  const std::vector<Task> tasks = missing_runs(runs, cache, report);
  if (tasks.empty()) return report;
  const int jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(jobs));
  const Shown shown(options.progress, tasks);
  Ensemble ensemble(runs, cache, runner, options, report);
  tbb::task_arena arena(jobs);
  arena.execute([&] { ensemble.run(tasks, jobs); });
  return report;
}

}  // namespace shakebed::sweeps
