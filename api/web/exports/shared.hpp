// What the exported functions have in common. They take addresses of the structs of plumb.h, which engine/layouts.mjs
// writes, and answer a PlumbResult; below 0, plumb_error() is the sentence.
#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "plumb/loader.hpp"

#define PLUMB_WEB(result, name) extern "C" __attribute__((export_name(#name))) result name

namespace plumb::web {

/// The sentence of the last failure.
std::string& last_error();

/// The backend that is linked in, as nothing is loaded at run time.
const Backend& backend();

/// call() answers a PlumbResult, or throws.
template <class Call>
PlumbResult guarded(const Call& call) {
  try {
    return call();
  } catch (const Error& error) {
    last_error() = error.what();
    return error.code();
  } catch (const std::exception& error) {
    last_error() = error.what();
    return PLUMB_E_INTERNAL;
  }
}

inline PlumbResult told(const IPhysicsWorld& world, PlumbResult result) {
  if (result < 0) last_error() = world.error_text();
  return result;
}

/// call(extension), which a backend may lack; what: "joints".
template <class Extension, class Call>
PlumbResult with(const IPhysicsWorld& world, Extension* extension, const char* what, const Call& call) {
  return guarded([&] {
    if (extension == nullptr) throw Error(PLUMB_E_UNSUPPORTED, std::string("this backend has no ") + what);
    return told(world, call(*extension));
  });
}

/// How many rows get() hands out, and where; or the result of its failure.
template <class Row, class Get>
std::int32_t lent(const Row** rows, const Get& get) {
  std::size_t count = 0;
  const PlumbResult result = guarded([&] {
    const std::span<const Row> all = get();
    *rows = all.data();
    count = all.size();
    return PLUMB_OK;
  });
  return result < 0 ? result : static_cast<std::int32_t>(count);
}

template <class Byte>
BasicRows<Byte> rows_at(Byte* numbers, std::uint32_t count, std::uint32_t columns) {
  return {numbers, count, columns * sizeof(double), PLUMB_F64};
}

}  // namespace plumb::web
