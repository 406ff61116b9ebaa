#pragma once

#include <functional>
#include <optional>
#include <string>

namespace shakebed::simulator {

/// Where a run keeps what it need not compute twice: prepared beds, which runs share, and
/// checkpoints, from which an interrupted run goes on. Bytes come back as they were given.
struct BedStore {
  std::function<std::optional<std::string>(const std::string& name)> load;
  std::function<void(const std::string& name, const std::string& bytes)> save;
  std::function<void(const std::string& name)> forget;
};

}  // namespace shakebed::simulator
