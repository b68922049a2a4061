#include "reference/hdf5_file.hpp"

#include <stdexcept>

namespace plumb::reference {
namespace {

constexpr hsize_t most_numbers = 100'000'000;
constexpr std::size_t memory_increment = 1 << 20;

/// A handle of the library's, closed at the end.
struct Handle {
  hid_t id;
  herr_t (*close)(hid_t);
  Handle(hid_t given, herr_t (*closes)(hid_t)) : id(given), close(closes) {}
  ~Handle() {
    if (id >= 0) close(id);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
};

/// The library prints its own failures unless it is told not to.
void keep_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

[[noreturn]] void fail_of(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

}  // namespace

void Hdf5File::fail(const std::string& what) const { fail_of(file_, what); }

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
  keep_quiet();
  if (!std::filesystem::is_regular_file(file)) fail_of(file, "there is no such file");
  if (H5Fis_hdf5(file.c_str()) <= 0) fail_of(file, "this is no HDF5 file");
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) fail_of(file, "the HDF5 file cannot be opened: it is torn, or somebody else has it open for writing");
  return {id, file};
}

Hdf5File Hdf5File::in_memory() {
  keep_quiet();
  const std::filesystem::path name = "an HDF5 file in memory";
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id, memory_increment, false);
  const hid_t id = H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id);
  if (id < 0) fail_of(name, "it cannot be made");
  return {id, name};
}

Hdf5File::~Hdf5File() { H5Fclose(id_); }

bool Hdf5File::has(const std::string& path) const {
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    if (H5Lexists(id_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

template <class Number>
std::vector<Number> Hdf5File::array(const std::string& path, H5T_class_t kind, hid_t type) const {
  if (!has(path)) fail(path + " is missing");
  const Handle set(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.id < 0) fail(path + " is no data set");
  const Handle held(H5Dget_type(set.id), H5Tclose), space(H5Dget_space(set.id), H5Sclose);
  if (H5Tget_class(held.id) != kind) fail(path + " holds no " + (kind == H5T_INTEGER ? "whole numbers" : "numbers"));
  const hssize_t count = H5Sget_simple_extent_npoints(space.id);
  if (count < 0 || static_cast<hsize_t>(count) > most_numbers) fail(path + " is too large");
  std::vector<Number> values(static_cast<std::size_t>(count));
  if (count > 0 && H5Dread(set.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(path + " cannot be read");
  return values;
}

std::vector<int> Hdf5File::integers(const std::string& path) const {
  return array<int>(path, H5T_INTEGER, H5T_NATIVE_INT);
}

std::vector<double> Hdf5File::numbers(const std::string& path) const {
  return array<double>(path, H5T_FLOAT, H5T_NATIVE_DOUBLE);
}

int Hdf5File::integer(const std::string& path) const {
  const std::vector<int> values = integers(path);
  if (values.size() != 1) fail(path + " holds " + std::to_string(values.size()) + " numbers, not one");
  return values.front();
}

std::string Hdf5File::text(const std::string& path) const {
  if (!has(path)) return "";
  const Handle set(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(set.id < 0 ? hid_t{-1} : H5Dget_type(set.id), H5Tclose);
  if (type.id < 0 || H5Tget_class(type.id) != H5T_STRING || H5Tis_variable_str(type.id) != 0) return "";
  std::string value(H5Tget_size(type.id), '\0');
  if (H5Dread(set.id, type.id, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) return "";
  return value.substr(0, value.find('\0'));
}

void Hdf5File::write(const std::string& path, hid_t type, const void* data, std::size_t count, bool scalar) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id, 1);
  const hsize_t size = count;
  const Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle set(H5Dcreate2(id_, path.c_str(), type, space.id, links.id, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (set.id < 0 || (count > 0 && H5Dwrite(set.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0))
    fail(path + " cannot be written");
}

void Hdf5File::put(const std::string& path, const std::vector<int>& values) {
  write(path, H5T_NATIVE_INT, values.data(), values.size(), false);
}

void Hdf5File::put(const std::string& path, const std::vector<double>& values) {
  write(path, H5T_NATIVE_DOUBLE, values.data(), values.size(), false);
}

void Hdf5File::put(const std::string& path, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id, text.size() + 1);
  write(path, type.id, text.c_str(), 1, true);
}

std::string Hdf5File::bytes() const {
  const ssize_t size = H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(id_, nullptr, 0);
  if (size < 0) fail("it cannot be completed");
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(id_, image.data(), image.size()) != size) fail("it cannot be read back");
  return image;
}

}  // namespace plumb::reference
