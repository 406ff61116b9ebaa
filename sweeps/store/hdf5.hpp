#pragma once

#include <hdf5.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/record.hpp"

// A thin layer over the HDF5 C API: handles that close themselves, and files::Error(failed) with
// "file:/group/dataset" and the library's own reason instead of error codes. Only what run files
// need: trees of groups, checksummed data sets of one or three columns, scalar attributes.
namespace shakebed::sweeps::store::hdf5 {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    Handle old(std::move(*this));
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// A group of an open file. Names keep the order in which they were made.
class Group {
 public:
  Group(Handle handle, std::string where) : handle_(std::move(handle)), where_(std::move(where)) {}

  const std::string& where() const { return where_; }  ///< "run.h5:/averages"

  Group make_group(const std::string& name) const;
  void write_attribute(const std::string& name, double value) const;
  void write_attribute(const std::string& name, std::int64_t value) const;
  void write_attribute(const std::string& name, std::uint64_t value) const;
  void write_attribute(const std::string& name, std::string_view text) const;

  /// Attributes of a data set written together with it.
  struct Labels {
    std::vector<std::pair<std::string, std::string>> texts;
    std::vector<std::pair<std::string, double>> numbers;
  };
  void write(const std::string& name, const std::vector<double>& values,
             const Labels& labels = {}) const;
  void write(const std::string& name, const std::vector<simulator::Estimate>& values,
             const Labels& labels = {}) const;
  void write(const std::string& name, const std::vector<std::int64_t>& values,
             const Labels& labels = {}) const;
  /// As a data set of n rows and three columns.
  void write(const std::string& name, const std::vector<std::array<double, 3>>& values,
             const Labels& labels = {}) const;
  void write(const std::string& name, const std::vector<std::string>& texts) const;

  Group group(const std::string& name) const;
  std::vector<std::string> names() const;
  double number_attribute(const std::string& name, const std::string& of = ".") const;
  std::int64_t integer_attribute(const std::string& name) const;
  std::uint64_t unsigned_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name, const std::string& of = ".") const;
  bool has_attribute(const std::string& name) const;
  std::vector<double> numbers(const std::string& name) const;
  std::vector<simulator::Estimate> estimates(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::vector<std::array<double, 3>> triples(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;

 private:
  std::string place(const std::string& name) const;
  Handle open_attribute(const std::string& name, const std::string& of) const;
  void write_scalar_attribute(hid_t object, const std::string& name, hid_t type,
                              const void* value) const;
  void write_text_attribute(hid_t object, const std::string& name, std::string_view text) const;
  void write_array(const std::string& name, hid_t type, std::size_t length, const void* values,
                   const Labels& labels, std::size_t columns = 1) const;
  Handle open_array(const std::string& name, std::size_t& length, std::size_t columns = 1) const;
  template <class Element>
  std::vector<Element> read_rows(const std::string& name, hid_t type, H5T_class_t kind,
                                 const char* what, std::size_t columns = 1) const;

  Handle handle_;
  std::string where_;
};

/// A whole file in memory. One `File` at a time exists: it holds a lock, because HDF5 serialises
/// its calls anyway and some builds of it are not thread-safe.
class File {
 public:
  static File create(std::string name);
  /// `image` is the content of the file; `name` stands in error messages.
  static File open(std::string name, std::string image);

  const Group& root() const { return root_; }
  /// Closes a created file and gives its bytes: std::move(file).finish().
  std::string finish() &&;

 private:
  File(std::unique_lock<std::mutex> lock, std::string name, std::string image, bool create);
  File(const File&) = delete;  // HDF5 keeps the address of content_
  File& operator=(const File&) = delete;

  std::unique_lock<std::mutex> lock_;
  std::string name_;
  std::string content_;  ///< filled when a created file closes
  Handle file_;
  Group root_;
};

}  // namespace shakebed::sweeps::store::hdf5
