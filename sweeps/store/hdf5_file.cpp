#include <cstdlib>
#include <cstring>

#include "files/error.hpp"
#include "sweeps/store/hdf5.hpp"
#include "sweeps/store/hdf5_errors.hpp"

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

}  // namespace

void fail(const std::string& where, const std::string& what) {
  throw files::failed(where, what + ": " + library_reason());
}

hid_t checked(hid_t id, const std::string& where, const char* what) {
  if (id < 0) fail(where, what);
  return id;
}

void check(herr_t status, const std::string& where, const char* what) {
  if (status < 0) fail(where, what);
}

Handle group_creation(hid_t property_class) {
  Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.id(), false);
  H5Pset_link_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return properties;
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
