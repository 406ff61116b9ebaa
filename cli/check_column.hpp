#pragma once

#include <string>

#include "files/csv.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::cli {

/// What the program makes of a bed in a container, on standard output.
void print_column_scene(const std::string& name, const simulator::Scene& scene);

/// Its contacts, one row a kind: parameters, effective mass, restitution e = exp(-gamma_n t_c/2)
/// and duration t_c = pi (k_n/m_eff - gamma_n^2/4)^(-1/2) of the linear law (Eqs. 9 and 10 of Sun
/// 2006; empty where over-damped), and t_c in time steps.
files::CsvTable column_contacts(const simulator::Scene& scene);

}  // namespace shakebed::cli
