#include "commands/recordings/hdf5_table.h"

#include <array>

namespace osteon {
namespace {

constexpr hsize_t kRowsOfChunk = 1024;
constexpr unsigned kDeflate = 1;

// Numbers pack well once bytes of one significance stand together; where the library has no zlib,
// they stand as they are.
Hdf5Handle chunked(std::span<const hsize_t> chunk) {
  Hdf5Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data());
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    H5Pset_shuffle(list.id());
    H5Pset_deflate(list.id(), kDeflate);
  }
  return list;
}

Hdf5Handle make_dataset(hid_t group, const std::string& name, hid_t type, std::size_t width) {
  const int dimensions = width == 1 ? 1 : 2;
  const std::array<hsize_t, 2> none = {0, width};
  const std::array<hsize_t, 2> most = {H5S_UNLIMITED, width};
  const std::array<hsize_t, 2> chunk = {kRowsOfChunk, width};
  const Hdf5Handle space(H5Screate_simple(dimensions, none.data(), most.data()), H5Sclose);
  const Hdf5Handle list = chunked(std::span(chunk).first(static_cast<std::size_t>(dimensions)));
  return {H5Dcreate2(group, name.c_str(), type, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
          H5Dclose};
}

bool set_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.ok() && H5Awrite(attribute.id(), type, value) >= 0;
}

}  // namespace

Hdf5Handle hdf5_text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

bool set_hdf5_attribute(hid_t object, const std::string& name, const std::string& text) {
  const char* const raw = text.c_str();
  return set_attribute(object, name, hdf5_text_type().id(), &raw);
}

bool set_hdf5_attribute(hid_t object, const std::string& name, double value) {
  return set_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

Hdf5Column::Hdf5Column(hid_t group, const std::string& name, hid_t type, std::size_t width,
                       const std::string& unit)
    : width_(width),
      dataset_(make_dataset(group, name, type, width)),
      ok_(dataset_.ok() && set_hdf5_attribute(dataset_.id(), "unit", unit)) {}

bool Hdf5Column::append(std::span<const std::string> rows) {
  std::vector<const char*> raw;
  for (const std::string& row : rows) raw.push_back(row.c_str());
  return write(hdf5_text_type().id(), raw.data(), raw.size());
}

bool Hdf5Column::write(hid_t type, const void* data, std::size_t count) {
  if (!ok_ || count == 0) return ok_;
  const int dimensions = width_ == 1 ? 1 : 2;
  const std::array<hsize_t, 2> from = {rows_, 0};
  const std::array<hsize_t, 2> size = {count / width_, width_};
  const std::array<hsize_t, 2> all = {rows_ + size[0], width_};
  ok_ = H5Dset_extent(dataset_.id(), all.data()) >= 0;
  const Hdf5Handle memory(H5Screate_simple(dimensions, size.data(), nullptr), H5Sclose);
  const Hdf5Handle file(H5Dget_space(dataset_.id()), H5Sclose);
  ok_ = ok_ && H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, from.data(), nullptr, size.data(),
                                   nullptr) >= 0;
  ok_ = ok_ && H5Dwrite(dataset_.id(), type, memory.id(), file.id(), H5P_DEFAULT, data) >= 0;
  rows_ = all[0];
  return ok_;
}

}  // namespace osteon
