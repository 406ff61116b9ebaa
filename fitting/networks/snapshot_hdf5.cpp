#include <cmath>
#include <limits>

#include "files/error.hpp"
#include "fitting/networks/snapshot.hpp"
#include "sweeps/store/hdf5.hpp"

namespace shakebed::fitting::networks {

namespace {

using sweeps::store::hdf5::Handle;

constexpr std::int64_t wall = -1;

/// An open file or group, and how error messages name it.
struct Located {
  Handle handle;
  std::string name;

  std::string inside(const std::string& child) const {
    return name + (name.ends_with('/') ? "" : "/") + child;
  }
};

Located open_file(const std::filesystem::path& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors become exceptions, not text
  Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (handle.id() < 0) {
    throw files::bad_input(file.string(),
                           std::filesystem::exists(file)
                               ? "cannot be opened as HDF5; it is something else, or cut short"
                               : "there is no such file");
  }
  return {std::move(handle), file.string() + ":/"};
}

Located open_group(const Located& parent, const std::string& name) {
  const bool there = H5Lexists(parent.handle.id(), name.c_str(), H5P_DEFAULT) > 0;
  Handle handle(there ? H5Gopen2(parent.handle.id(), name.c_str(), H5P_DEFAULT) : -1, H5Gclose);
  if (handle.id() < 0) {
    throw files::bad_input(parent.inside(name),
                           there ? "cannot be read as a group; the file may be damaged"
                                 : "is not in the file; expected /snapshots/NAME and "
                                   "/contacts/NAME as `shakebed run` writes them");
  }
  return {std::move(handle), parent.inside(name)};
}

std::vector<std::string> names(const Located& group) {
  H5G_info_t info{};
  H5Gget_info(group.handle.id(), &info);
  std::vector<std::string> found;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    char buffer[256] = {};
    H5Lget_name_by_idx(group.handle.id(), ".", H5_INDEX_NAME, H5_ITER_INC, k, buffer, sizeof buffer,
                       H5P_DEFAULT);
    found.emplace_back(buffer);
  }
  return found;
}

/// A data set of `columns` numbers a row (1: a plain list), of the class asked for.
template <class Number>
std::vector<Number> read(const Located& group, const std::string& name, hsize_t columns) {
  constexpr bool whole = std::is_integral_v<Number>;
  const std::string where = group.inside(name);
  const bool there = H5Lexists(group.handle.id(), name.c_str(), H5P_DEFAULT) > 0;
  const Handle data(there ? H5Dopen2(group.handle.id(), name.c_str(), H5P_DEFAULT) : -1, H5Dclose);
  if (data.id() < 0) throw files::bad_input(where, "the data set is missing or unreadable");
  const Handle type(H5Dget_type(data.id()), H5Tclose);
  const Handle space(H5Dget_space(data.id()), H5Sclose);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space.id(), size, nullptr);
  if (rank != (columns == 1 ? 1 : 2) || size[1] != columns ||
      H5Tget_class(type.id()) != (whole ? H5T_INTEGER : H5T_FLOAT)) {
    throw files::bad_input(where, std::string("expected ") + (whole ? "integers" : "real numbers") +
                                      ", " + std::to_string(columns) + " a row");
  }
  std::vector<Number> values(static_cast<std::size_t>(size[0] * size[1]));
  if (H5Dread(data.id(), whole ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL,
              H5P_DEFAULT, values.data()) < 0) {
    throw files::bad_input(where, "cannot be read; the file is cut short or damaged");
  }
  return values;
}

void require_length(const Located& group, const std::string& name, std::size_t got,
                    std::size_t expected) {
  if (got == expected) return;
  throw files::bad_input(group.inside(name), "expected " + std::to_string(expected) +
                                                 " rows as in its group's first data set, got " +
                                                 std::to_string(got));
}

std::vector<GrainRow> grain_rows(const Located& group) {
  const auto id = read<std::int64_t>(group, "id", 1);
  const auto position = read<double>(group, "position", 3);
  const auto radius = read<double>(group, "radius", 1);
  require_length(group, "position", position.size() / 3, id.size());
  require_length(group, "radius", radius.size(), id.size());
  std::vector<GrainRow> rows;
  for (std::size_t k = 0; k < id.size(); ++k) {
    rows.push_back({id[k], {position[3 * k], position[3 * k + 1], position[3 * k + 2]}, radius[k]});
  }
  return rows;
}

std::vector<ContactRow> contact_rows(const Located& group) {
  const auto i = read<std::int64_t>(group, "i", 1);
  const auto j = read<std::int64_t>(group, "j", 1);
  const auto force = read<double>(group, "normal_force", 1);
  require_length(group, "j", j.size(), i.size());
  require_length(group, "normal_force", force.size(), i.size());
  std::vector<ContactRow> rows;
  for (std::size_t k = 0; k < i.size(); ++k) {
    rows.push_back({i[k], j[k] == wall ? std::nullopt : std::optional(j[k]), force[k]});
  }
  return rows;
}

/// "run.h5:NAME" in its parts; a colon belongs to the name of a file that exists.
std::pair<std::filesystem::path, std::string> file_and_name(const std::filesystem::path& given) {
  const std::string text = given.string();
  const std::size_t colon = text.rfind(':');
  if (std::filesystem::exists(given) || colon == std::string::npos) return {given, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::string only_name(const Located& snapshots) {
  const auto all = names(snapshots);
  if (all.size() == 1) return all.front();
  std::string what = "holds " + std::to_string(all.size()) + " snapshots";
  if (!all.empty()) what += "; name one after a colon, FILE:NAME. It has";
  for (const auto& name : all) what += " " + name;
  throw files::bad_input(snapshots.name, what);
}

}  // namespace

Snapshot read_snapshot_hdf5(const std::filesystem::path& given) {
  const auto [file, asked] = file_and_name(given);
  const Located root = open_file(file);
  const Located snapshots = open_group(root, "snapshots");
  const std::string name = asked.empty() ? only_name(snapshots) : asked;
  const Located grains = open_group(snapshots, name);
  const Located contacts = open_group(open_group(root, "contacts"), name);
  const auto grain_list = grain_rows(grains);
  const auto contact_list = contact_rows(contacts);
  return assemble(
      grains.name, grain_list,
      [&](std::size_t row) { return grains.name + ", row " + std::to_string(row + 1); },
      contact_list,
      [&](std::size_t row) { return contacts.name + ", row " + std::to_string(row + 1); });
}

}  // namespace shakebed::fitting::networks
