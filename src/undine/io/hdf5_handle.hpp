#pragma once
#include <string>
#include <utility>

#include <hdf5.h>

#include "undine/io/hdf5_file.hpp"

// What the sources of Hdf5File share; nothing else includes it, so that no other file needs HDF5's headers.
namespace undine::hdf5 {

static_assert(std::same_as<hid_t, std::int64_t>);

inline constexpr std::size_t largest_text = std::size_t{64} << 20;

/// Owns one HDF5 identifier.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

template <Hdf5Number T>
hid_t memory_type() {
  if constexpr (std::same_as<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::same_as<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::same_as<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::same_as<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::same_as<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

/// The innermost reason on HDF5's error stack; the system's own words where it quotes them.
std::string reason();

/// How an attribute is called in an error.
std::string attribute_label(const std::string& object, const std::string& name);

}  // namespace undine::hdf5
