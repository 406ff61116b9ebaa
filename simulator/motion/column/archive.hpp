#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "files/error.hpp"

namespace shakebed::simulator {

/// Writes plain values one after the other: the bytes of a checkpoint.
class ByteWriter {
 public:
  template <class Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Value>
  void operator()(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    (*this)(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  }
  std::string take() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads them back in the same order. Throws files::Error(failed) when they are cut short.
class ByteReader {
 public:
  ByteReader(const std::string& bytes, std::string where)
      : bytes_(bytes), where_(std::move(where)) {}

  template <class Value>
  void operator()(Value& value) {
    std::memcpy(static_cast<void*>(&value), next(sizeof value), sizeof value);
  }
  template <class Value>
  void operator()(std::vector<Value>& values) {
    std::size_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / sizeof(Value)) refuse();
    const char* from = next(count * sizeof(Value));
    values.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), from, count * sizeof(Value));
  }
  void finish() const {
    if (at_ != bytes_.size()) refuse();
  }

 private:
  const char* next(std::size_t count) {
    if (count > bytes_.size() - at_) refuse();
    const char* here = bytes_.data() + at_;
    at_ += count;
    return here;
  }
  [[noreturn]] void refuse() const {
    throw files::failed(where_, "is cut short or was written by another version; remove it");
  }

  const std::string& bytes_;
  std::string where_;
  std::size_t at_ = 0;
};

}  // namespace shakebed::simulator
