#pragma once

#include <string>
#include <tl/expected.hpp>

namespace osteon {

/// A failure that its user can act on: what went wrong, where, and what to do about it.
struct Error {
  std::string what;   ///< "the mesh has no triangles"
  std::string where;  ///< file, line, device or field
  std::string todo;   ///< "export it again as a closed surface"

  /// One sentence for a terminal or a message box.
  std::string message() const;
};

/// Files, devices and users fail this way; bugs assert, see check.h.
template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string what, std::string where = {}, std::string todo = {}) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(where), std::move(todo)});
}

}  // namespace osteon
