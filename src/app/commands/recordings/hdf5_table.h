#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace osteon {

/// A handle of the HDF5 library, closed at the end.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  hid_t id() const { return id_; }
  bool ok() const { return id_ >= 0; }
  /// What is still to be written is: false when it could not be.
  bool close() {
    const bool closed = id_ >= 0 && close_(id_) >= 0;
    id_ = -1;
    return closed;
  }

 private:
  hid_t id_;
  Close close_;
};

/// A dataset of rows that grows; every call is false once one has failed.
class Hdf5Column {
 public:
  /// `width` numbers or texts in a row; 1: the dataset has one dimension. `type`: of the elements.
  Hdf5Column(hid_t group, const std::string& name, hid_t type, std::size_t width,
             const std::string& unit);
  bool append(std::span<const double> rows) {
    return write(H5T_NATIVE_DOUBLE, rows.data(), rows.size());
  }
  bool append(std::span<const std::uint64_t> rows) {
    return write(H5T_NATIVE_UINT64, rows.data(), rows.size());
  }
  bool append(std::span<const std::string> rows);
  bool close() { return dataset_.close() && ok_; }

 private:
  bool write(hid_t type, const void* data, std::size_t count);

  std::size_t width_;
  Hdf5Handle dataset_;
  hsize_t rows_ = 0;
  bool ok_;
};

/// UTF-8 of any length.
Hdf5Handle hdf5_text_type();
bool set_hdf5_attribute(hid_t object, const std::string& name, const std::string& text);
bool set_hdf5_attribute(hid_t object, const std::string& name, double value);

}  // namespace osteon
