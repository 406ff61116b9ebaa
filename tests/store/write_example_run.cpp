#include "sweeps/store/run_file.hpp"
#include "tests/store/example_record.hpp"

/// Writes the example record for readers in other languages.
int main(int, char** arguments) {
  shakebed::sweeps::store::write_run_file(
      arguments[1], shakebed::tests::example_record(),
      {"0.1.0", "0123456789ab", "GNU 12", "-O3", "native", "release", "a CPU"});
}
