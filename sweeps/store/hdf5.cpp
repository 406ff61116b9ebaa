#include "sweeps/store/hdf5.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "files/error.hpp"

namespace shakebed::sweeps::store::hdf5 {
namespace {

/// The innermost entry of HDF5's error stack says what happened; the outer ones only repeat it.
std::string library_reason() {
  std::string reason;
  const auto keep_innermost = [](unsigned depth, const H5E_error2_t* entry, void* text) -> herr_t {
    if (depth == 0 && entry->desc != nullptr) *static_cast<std::string*>(text) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw files::failed(where, what + ": " + library_reason());
}

hid_t checked(hid_t id, const std::string& where, const char* what) {
  if (id < 0) fail(where, what);
  return id;
}

void check(herr_t status, const std::string& where, const char* what) {
  if (status < 0) fail(where, what);
}

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::unique_lock<std::mutex> lock_library() {
  std::unique_lock lock(library_mutex());
  // Per thread: errors become exceptions, not text on the user's terminal.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return lock;
}

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

/// Times would make equal results differ, and lose the order in which names were made.
Handle group_creation(hid_t property_class) {
  Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.id(), false);
  H5Pset_link_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return properties;
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
                        const Labels& labels) const {
  if (name.empty() || name.find('/') != std::string::npos) {
    throw files::failed(place(name), "a data set cannot have this name");
  }
  const hsize_t size = length;
  // Only a growing data set may be empty and chunked.
  const hsize_t largest = length == 0 ? H5S_UNLIMITED : size;
  const hsize_t chunk = std::clamp<hsize_t>(size, 1, 8192);
  const Handle space(H5Screate_simple(1, &size, &largest), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.id(), false);
  H5Pset_chunk(properties.id(), 1, &chunk);
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

void Group::write(const std::string& name, const std::vector<std::string>& texts) const {
  std::size_t width = 1;
  for (const auto& text : texts) width = std::max(width, text.size());
  std::string padded;
  for (const auto& text : texts) padded += text + std::string(width - text.size(), '\0');
  write_array(name, text_type(width).id(), texts.size(), padded.data(), {});
}

Handle Group::open_array(const std::string& name, std::size_t& length) const {
  Handle dataset(checked(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), place(name),
                         "cannot read the data set"),
                 H5Dclose);
  const Handle space(checked(H5Dget_space(dataset.id()), place(name), "cannot read the extent"),
                     H5Sclose);
  if (H5Sget_simple_extent_ndims(space.id()) != 1) {
    throw files::failed(place(name), "is not one-dimensional as a run file has it");
  }
  hsize_t size = 0;
  H5Sget_simple_extent_dims(space.id(), &size, nullptr);
  length = static_cast<std::size_t>(size);
  return dataset;
}

std::vector<double> Group::numbers(const std::string& name) const {
  std::size_t length = 0;
  const Handle dataset = open_array(name, length);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  require_class(type.id(), H5T_FLOAT, place(name), "a list of numbers");
  std::vector<double> values(length);
  check(H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        place(name), "cannot read the data set");
  return values;
}

std::vector<simulator::Estimate> Group::estimates(const std::string& name) const {
  std::size_t length = 0;
  const Handle dataset = open_array(name, length);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  require_class(type.id(), H5T_COMPOUND, place(name), "a list of means and errors");
  std::vector<simulator::Estimate> values(length);
  check(H5Dread(dataset.id(), estimate_type().id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        place(name), "cannot read the data set");
  return values;
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

namespace {

/// The bytes that a file in memory is kept in. H5Fget_file_image would give them too, but clears a
/// flag in the superblock without renewing its checksum (tried with 1.10.8), so that the image does
/// not open; what the core driver holds when the file closes is the finished file.
namespace image {

void* allocate(std::size_t size, H5FD_file_image_op_t, void*) { return std::malloc(size); }

void* copy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::memcpy(to, from, size);
}

void* resize(void* memory, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::realloc(memory, size);
}

herr_t release(void* memory, H5FD_file_image_op_t operation, void* bytes) {
  if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE && memory != nullptr) {
    // HDF5 File Format 3.0, superblock version 2 and 3: bytes 28 to 35 are the end of the file,
    // little-endian; the memory is larger.
    std::uint64_t size = 0;
    std::memcpy(&size, static_cast<const char*>(memory) + 28, sizeof size);
    static_cast<std::string*>(bytes)->assign(static_cast<const char*>(memory), size);
  }
  std::free(memory);
  return 0;
}

void* share(void* bytes) { return bytes; }
herr_t forget(void*) { return 0; }

}  // namespace image

/// Newest format of HDF5 1.10: its metadata carries checksums, so that damage is seen.
Handle memory_access(const std::string& name) {
  Handle access(checked(H5Pcreate(H5P_FILE_ACCESS), name, "cannot start HDF5"), H5Pclose);
  const std::size_t growth = 1 << 16;
  H5Pset_fapl_core(access.id(), growth, /*backing_store=*/false);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  return access;
}

constexpr const char* image_name = "shakebed-run-file-in-memory";

Handle create_in_memory(const std::string& name, std::string& content) {
  const Handle properties = group_creation(H5P_FILE_CREATE);
  const Handle access = memory_access(name);
  H5FD_file_image_callbacks_t callbacks{image::allocate, image::copy,  image::resize,
                                        image::release,  image::share, image::forget,
                                        &content};
  check(H5Pset_file_image_callbacks(access.id(), &callbacks), name,
        "cannot make an HDF5 file in memory");
  return {checked(H5Fcreate(image_name, H5F_ACC_TRUNC, properties.id(), access.id()), name,
                  "cannot make an HDF5 file in memory"),
          H5Fclose};
}

Handle open_in_memory(const std::string& name, std::string& content) {
  const Handle access = memory_access(name);
  check(H5Pset_file_image(access.id(), content.data(), content.size()), name,
        "cannot hand the file to HDF5");
  const hid_t file = H5Fopen(image_name, H5F_ACC_RDONLY, access.id());
  return {checked(file, name, "is not a complete HDF5 file"), H5Fclose};
}

}  // namespace

File::File(std::unique_lock<std::mutex> lock, std::string name, std::string image, bool create)
    : lock_(std::move(lock)),
      name_(std::move(name)),
      content_(std::move(image)),
      file_(create ? create_in_memory(name_, content_) : open_in_memory(name_, content_)),
      root_(Handle(checked(H5Gopen2(file_.id(), "/", H5P_DEFAULT), name_, "cannot read the root"),
                   H5Gclose),
            name_ + ":/") {}

File File::create(std::string name) { return {lock_library(), std::move(name), {}, true}; }

File File::open(std::string name, std::string image) {
  return {lock_library(), std::move(name), std::move(image), false};
}

std::string File::finish() && {
  check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), name_, "cannot flush the file");
  root_ = Group(Handle(), name_);
  file_ = Handle();
  if (content_.empty()) fail(name_, "cannot finish the HDF5 file in memory");
  return std::move(content_);
}

}  // namespace shakebed::sweeps::store::hdf5
