#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>

#include "tests/sweeps/small_sweep.hpp"

// The built program on real, tiny beds.
namespace shakebed::tests {
namespace {

struct Outcome {
  int exit_code;
  std::string text;  ///< standard output and error
};

/// Starts `shakebed sweep VERB SWEEP --cache CACHE ...`; the child replaces itself, so that signals
/// reach it and not a shell.
class Command {
 public:
  Command(std::vector<std::string> words) {
    std::array<int, 2> ends{};
    REQUIRE(::pipe(ends.data()) == 0);
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(ends[1], STDERR_FILENO);
      words.insert(words.begin(), {SHAKEBED_PROGRAM, "sweep"});
      std::vector<char*> arguments;
      for (auto& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ends[0];
  }
  void send(int signal) const { ::kill(child_, signal); }
  Outcome wait() const {
    Outcome outcome{};
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = ::read(output_, buffer.data(), buffer.size())) > 0;) {
      outcome.text.append(buffer.data(), static_cast<std::size_t>(got));
    }
    ::close(output_);
    int status = 0;
    ::waitpid(child_, &status, 0);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return outcome;
  }

 private:
  pid_t child_ = 0;
  int output_ = 0;
};

class Session {
 public:
  explicit Session(const std::string& body) : sweep_(small.write(body).string()) {}
  Command start(const std::string& verb, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{verb, sweep_, "--cache", cache().string()};
    words.insert(words.end(), more.begin(), more.end());
    return Command(words);
  }
  Outcome run(const std::string& verb, const std::vector<std::string>& more = {}) const {
    return start(verb, more).wait();
  }
  std::filesystem::path cache() const { return small.folder.path() / "cache"; }
  SmallSweep small;

 private:
  std::string sweep_;
};

const std::string tiny = "axes: [{key: base.drive.W, values: [4, 9]}]\nreplicates: 2\n";

TEST_CASE("run, run again, status, collect") {
  const Session session(tiny);
  const Outcome nothing = session.run("collect");
  CHECK(nothing.exit_code == 1);
  CHECK_THAT(nothing.text, Catch::Contains("sweep run"));
  CHECK_THAT(session.run("status").text, Catch::Contains("2 points, 4 runs: 0 cached, 4 missing"));

  const Outcome first = session.run("run", {"--jobs", "2"});
  INFO(first.text);
  CHECK(first.exit_code == 0);
  CHECK_THAT(first.text, Catch::Contains("4 runs: 0 cached, 4 simulated, 0 failed"));
  CHECK_THAT(session.run("run").text, Catch::Contains("4 cached, 0 simulated"));
  CHECK_THAT(session.run("status").text, Catch::Contains("4 cached, 0 missing"));

  const auto table = session.small.folder.path() / "table.csv";
  CHECK(session.run("collect", {"--csv", table.string()}).exit_code == 0);
  const auto read = files::CsvTable::read(table);
  CHECK(read.rows() == 2);
  CHECK(read.numbers("W")[1] == Approx(9));
  CHECK(read.numbers("T_z")[1] > 0);
  CHECK(read.numbers("replicates") == std::vector<double>{2, 2});
  CHECK(session.run("collect").text == files::read_text(table));
}

TEST_CASE("Wrong input ends with exit code 2 and leaves no cache") {
  const Session session("axes: [{key: base.drive.WW, values: [4]}]\n");
  const Outcome wrong = session.run("run");
  CHECK(wrong.exit_code == 2);
  CHECK_THAT(wrong.text, Catch::Contains("sweep.yaml:4:") && Catch::Contains("WW"));
  CHECK_FALSE(std::filesystem::exists(session.cache()));

  const Session foreign(tiny);
  files::write_text(foreign.cache() / "LAYOUT", "shakebed cache, layout 99\n");
  for (const char* verb : {"run", "status", "collect"}) {
    const Outcome refused = foreign.run(verb);
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.text, Catch::Contains("another schema"));
  }
}

TEST_CASE("Ctrl-C ends with exit code 130, and nothing partial is left") {
  const Session session(
      "set: {protocol.measure.cycles: 100000000}\n"
      "axes: [{key: base.drive.W, values: [4, 9]}]\n");
  const Command command = session.start("run", {"--jobs", "1"});
  ::usleep(700000);
  command.send(SIGINT);
  const Outcome stopped = command.wait();
  CHECK(stopped.exit_code == 130);
  CHECK_THAT(stopped.text, Catch::Contains("rerun the same command to resume"));
  CHECK_FALSE(std::filesystem::exists(session.cache()));
}

}  // namespace
}  // namespace shakebed::tests
