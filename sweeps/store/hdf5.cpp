#include "sweeps/store/hdf5.hpp"

#include <algorithm>

#include "files/error.hpp"
#include "sweeps/store/hdf5_errors.hpp"

namespace shakebed::sweeps::store::hdf5 {
namespace {

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(length, 1));
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  return type;
}

Handle estimate_type() {
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(simulator::Estimate)), H5Tclose);
  H5Tinsert(type.id(), "mean", HOFFSET(simulator::Estimate, mean), H5T_NATIVE_DOUBLE);
  H5Tinsert(type.id(), "standard_error", HOFFSET(simulator::Estimate, standard_error),
            H5T_NATIVE_DOUBLE);
  return type;
}

void require_class(hid_t type, H5T_class_t expected, const std::string& where, const char* name) {
  if (H5Tget_class(type) != expected) {
    throw files::failed(where, std::string("is not ") + name + " as a run file has it");
  }
}

std::string without_padding(std::string_view text) {
  return std::string(text.substr(0, text.find('\0')));
}

}  // namespace

std::string Group::place(const std::string& name) const {
  if (name == ".") return where_;
  return where_.ends_with('/') ? where_ + name : where_ + "/" + name;
}

Group Group::make_group(const std::string& name) const {
  const Handle properties = group_creation(H5P_GROUP_CREATE);
  const hid_t id =
      H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT);
  return {Handle(checked(id, place(name), "cannot make the group"), H5Gclose), place(name)};
}

Group Group::group(const std::string& name) const {
  const hid_t id = H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT);
  return {Handle(checked(id, place(name), "cannot read the group"), H5Gclose), place(name)};
}

std::vector<std::string> Group::names() const {
  H5G_info_t info{};
  check(H5Gget_info(handle_.id(), &info), where_, "cannot list the group");
  std::vector<std::string> found;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    const auto get = [&](char* buffer, std::size_t size) {
      return H5Lget_name_by_idx(handle_.id(), ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, k, buffer, size,
                                H5P_DEFAULT);
    };
    const ssize_t length = get(nullptr, 0);
    if (length < 0) fail(where_, "cannot list the group");
    std::string name(static_cast<std::size_t>(length), '\0');
    if (get(name.data(), name.size() + 1) < 0) fail(where_, "cannot list the group");
    found.push_back(std::move(name));
  }
  return found;
}

void Group::write_scalar_attribute(hid_t object, const std::string& name, hid_t type,
                                   const void* value) const {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      checked(H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
              place(name), "cannot make the attribute"),
      H5Aclose);
  check(H5Awrite(attribute.id(), type, value), place(name), "cannot write the attribute");
}

void Group::write_text_attribute(hid_t object, const std::string& name,
                                 std::string_view text) const {
  const Handle type = text_type(text.size());
  write_scalar_attribute(object, name, type.id(), text.empty() ? "" : text.data());
}

void Group::write_attribute(const std::string& name, double value) const {
  write_scalar_attribute(handle_.id(), name, H5T_NATIVE_DOUBLE, &value);
}
void Group::write_attribute(const std::string& name, std::int64_t value) const {
  write_scalar_attribute(handle_.id(), name, H5T_NATIVE_INT64, &value);
}
void Group::write_attribute(const std::string& name, std::uint64_t value) const {
  write_scalar_attribute(handle_.id(), name, H5T_NATIVE_UINT64, &value);
}
void Group::write_attribute(const std::string& name, std::string_view text) const {
  write_text_attribute(handle_.id(), name, text);
}

void Group::write_array(const std::string& name, hid_t type, std::size_t length, const void* values,
                        const Labels& labels, std::size_t columns) const {
  if (name.empty() || name.find('/') != std::string::npos) {
    throw files::failed(place(name), "a data set cannot have this name");
  }
  const int rank = columns == 1 ? 1 : 2;
  const hsize_t size[2] = {length, columns};
  // Only a growing data set may be empty and chunked.
  const hsize_t largest[2] = {length == 0 ? H5S_UNLIMITED : length, columns};
  const hsize_t chunk[2] = {std::clamp<hsize_t>(length, 1, 8192), columns};
  const Handle space(H5Screate_simple(rank, size, largest), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.id(), false);
  H5Pset_chunk(properties.id(), rank, chunk);
  H5Pset_fletcher32(properties.id());
  const Handle dataset(checked(H5Dcreate2(handle_.id(), name.c_str(), type, space.id(), H5P_DEFAULT,
                                          properties.id(), H5P_DEFAULT),
                               place(name), "cannot make the data set"),
                       H5Dclose);
  if (length > 0) {
    check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), place(name),
          "cannot write the data set");
  }
  for (const auto& [label, text] : labels.texts) write_text_attribute(dataset.id(), label, text);
  for (const auto& [label, number] : labels.numbers) {
    write_scalar_attribute(dataset.id(), label, H5T_NATIVE_DOUBLE, &number);
  }
}

void Group::write(const std::string& name, const std::vector<double>& values,
                  const Labels& labels) const {
  write_array(name, H5T_NATIVE_DOUBLE, values.size(), values.data(), labels);
}

void Group::write(const std::string& name, const std::vector<simulator::Estimate>& values,
                  const Labels& labels) const {
  write_array(name, estimate_type().id(), values.size(), values.data(), labels);
}

void Group::write(const std::string& name, const std::vector<std::int64_t>& values,
                  const Labels& labels) const {
  write_array(name, H5T_NATIVE_INT64, values.size(), values.data(), labels);
}

void Group::write(const std::string& name, const std::vector<std::array<double, 3>>& values,
                  const Labels& labels) const {
  write_array(name, H5T_NATIVE_DOUBLE, values.size(), values.data(), labels, 3);
}

void Group::write(const std::string& name, const std::vector<std::string>& texts) const {
  std::size_t width = 1;
  for (const auto& text : texts) width = std::max(width, text.size());
  std::string padded;
  for (const auto& text : texts) padded += text + std::string(width - text.size(), '\0');
  write_array(name, text_type(width).id(), texts.size(), padded.data(), {});
}

Handle Group::open_array(const std::string& name, std::size_t& length, std::size_t columns) const {
  Handle dataset(checked(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), place(name),
                         "cannot read the data set"),
                 H5Dclose);
  const Handle space(checked(H5Dget_space(dataset.id()), place(name), "cannot read the extent"),
                     H5Sclose);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space.id(), size, nullptr);
  if (rank != (columns == 1 ? 1 : 2) || size[1] != columns) {
    throw files::failed(place(name), "has not " + std::to_string(columns) +
                                         (columns == 1 ? " number" : " numbers") +
                                         " a row as a run file has it");
  }
  length = static_cast<std::size_t>(size[0]);
  return dataset;
}

/// A data set whose rows are `Element`s, which HDF5 knows as `type` (of class `kind`).
template <class Element>
std::vector<Element> Group::read_rows(const std::string& name, hid_t type, H5T_class_t kind,
                                      const char* what, std::size_t columns) const {
  std::size_t length = 0;
  const Handle dataset = open_array(name, length, columns);
  const Handle stored(H5Dget_type(dataset.id()), H5Tclose);
  require_class(stored.id(), kind, place(name), what);
  std::vector<Element> values(length);
  check(H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), place(name),
        "cannot read the data set");
  return values;
}

std::vector<double> Group::numbers(const std::string& name) const {
  return read_rows<double>(name, H5T_NATIVE_DOUBLE, H5T_FLOAT, "a list of numbers");
}

std::vector<std::int64_t> Group::integers(const std::string& name) const {
  return read_rows<std::int64_t>(name, H5T_NATIVE_INT64, H5T_INTEGER, "a list of integers");
}

std::vector<std::array<double, 3>> Group::triples(const std::string& name) const {
  return read_rows<std::array<double, 3>>(name, H5T_NATIVE_DOUBLE, H5T_FLOAT, "a table of numbers",
                                          3);
}

std::vector<simulator::Estimate> Group::estimates(const std::string& name) const {
  return read_rows<simulator::Estimate>(name, estimate_type().id(), H5T_COMPOUND,
                                        "a list of means and errors");
}

bool Group::has(const std::string& name) const {
  return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Group::texts(const std::string& name) const {
  std::size_t length = 0;
  const Handle dataset = open_array(name, length);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  require_class(type.id(), H5T_STRING, place(name), "a list of texts");
  const std::size_t width = H5Tget_size(type.id());
  std::string padded(width * length, '\0');
  check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), place(name),
        "cannot read the data set");
  std::vector<std::string> found;
  for (std::size_t k = 0; k < length; ++k) {
    found.push_back(without_padding(std::string_view(padded).substr(k * width, width)));
  }
  return found;
}

bool Group::has_attribute(const std::string& name) const {
  return H5Aexists(handle_.id(), name.c_str()) > 0;
}

Handle Group::open_attribute(const std::string& name, const std::string& of) const {
  return {checked(H5Aopen_by_name(handle_.id(), of.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                  place(of), ("cannot read the attribute " + name).c_str()),
          H5Aclose};
}

double Group::number_attribute(const std::string& name, const std::string& of) const {
  const Handle attribute = open_attribute(name, of);
  double value = 0;
  check(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value), place(of), "cannot read an attribute");
  return value;
}

std::int64_t Group::integer_attribute(const std::string& name) const {
  const Handle attribute = open_attribute(name, ".");
  std::int64_t value = 0;
  check(H5Aread(attribute.id(), H5T_NATIVE_INT64, &value), where_, "cannot read an attribute");
  return value;
}

std::uint64_t Group::unsigned_attribute(const std::string& name) const {
  const Handle attribute = open_attribute(name, ".");
  std::uint64_t value = 0;
  check(H5Aread(attribute.id(), H5T_NATIVE_UINT64, &value), where_, "cannot read an attribute");
  return value;
}

std::string Group::text_attribute(const std::string& name, const std::string& of) const {
  const Handle attribute = open_attribute(name, of);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  require_class(type.id(), H5T_STRING, place(of), "labelled");
  std::string padded(H5Tget_size(type.id()), '\0');
  check(H5Aread(attribute.id(), type.id(), padded.data()), place(of), "cannot read an attribute");
  return without_padding(padded);
}

}  // namespace shakebed::sweeps::store::hdf5
