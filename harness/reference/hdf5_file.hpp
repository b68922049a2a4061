// The little of HDF5 that FCLIB's files need: numbers, arrays and strings at paths. Inner part of fclib.hpp.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::reference {

/// An open file. All failures are std::runtime_error that names the file and the path inside.
class Hdf5File {
 public:
  static Hdf5File open(const std::filesystem::path& file);
  /// An empty one on no disk, to be filled: the library cannot close a file whose last bytes found no room.
  static Hdf5File in_memory();
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  [[nodiscard]] bool has(const std::string& path) const;
  [[nodiscard]] std::vector<int> integers(const std::string& path) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const;
  [[nodiscard]] int integer(const std::string& path) const;       ///< an array of one
  [[nodiscard]] std::string text(const std::string& path) const;  ///< "" where there is none

  /// Groups on the way are made.
  void put(const std::string& path, const std::vector<int>& values);
  void put(const std::string& path, const std::vector<double>& values);
  void put(const std::string& path, int value) { put(path, std::vector<int>{value}); }
  void put(const std::string& path, const std::string& text);

  [[nodiscard]] std::string bytes() const;  ///< the file as it is now

  [[noreturn]] void fail(const std::string& what) const;

 private:
  Hdf5File(hid_t id, std::filesystem::path file) : id_(id), file_(std::move(file)) {}
  template <class Number>
  [[nodiscard]] std::vector<Number> array(const std::string& path, H5T_class_t kind, hid_t type) const;
  void write(const std::string& path, hid_t type, const void* data, std::size_t count, bool scalar);

  hid_t id_;
  std::filesystem::path file_;
};

}  // namespace plumb::reference
