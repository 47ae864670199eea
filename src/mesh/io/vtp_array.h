#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osteon {

/// One element of an XML text: its head without the angles, and what stands between its tags.
struct XmlElement {
  std::string_view head, body;
  /// Of an attribute; empty when it is not there.
  std::string_view attribute(std::string_view name) const;
};
/// The next element of this name from `at`, which moves behind it; none when there is none.
std::optional<XmlElement> next_element(std::string_view text, std::string_view name,
                                       std::size_t& at);

/// How a VTK XML file writes its arrays.
struct VtpEncoding {
  bool wide_header = false;   ///< counts of bytes are of 8 bytes, else of 4
  bool packed = false;        ///< by zlib
  std::string_view appended;  ///< what follows the underscore, to the end of the file
  bool appended_base64 = false;
};

/// The numbers of a DataArray; none when it cannot be read.
std::optional<std::vector<double>> vtp_numbers(const XmlElement& array,
                                               const VtpEncoding& encoding);

}  // namespace osteon
