#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace shakebed::files {

/// One thing that is wrong: where it is ("scene.yaml:4:12", "run.h5:/averages/T_z"),
/// what was expected, what was found, and what the user can do about it.
struct Fault {
  std::string where;
  std::string what;  ///< one or two sentences: expected, got, what to do
};

/// Every error a user can cause or must act on. Only `main` turns it into an exit code.
class Error : public std::runtime_error {
 public:
  enum class Kind {
    bad_input,  ///< the user's file, key, value or command line; exit code 2
    failed      ///< the work could not be done (disk full, bed not stationary, ...); exit code 1
  };

  Error(Kind kind, std::vector<Fault> faults)
      : std::runtime_error(joined(faults)), kind_(kind), faults_(std::move(faults)) {}
  Error(Kind kind, std::string where, std::string what)
      : Error(kind, std::vector<Fault>{{std::move(where), std::move(what)}}) {}

  Kind kind() const { return kind_; }
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  static std::string joined(const std::vector<Fault>& faults) {
    std::string text;
    for (const auto& fault : faults) {
      if (!text.empty()) text += '\n';
      if (!fault.where.empty()) text += fault.where + ": ";
      text += fault.what;
    }
    return text;
  }

  Kind kind_;
  std::vector<Fault> faults_;
};

/// Ctrl-C: what was finished is kept, nothing partial is left. Exit code 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; rerun the same command to resume") {}
};

inline Error bad_input(std::string where, std::string what) {
  return {Error::Kind::bad_input, std::move(where), std::move(what)};
}
inline Error failed(std::string where, std::string what) {
  return {Error::Kind::failed, std::move(where), std::move(what)};
}

}  // namespace shakebed::files
