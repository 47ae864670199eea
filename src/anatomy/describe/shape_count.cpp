#include "describe/shape_count.h"

#include <algorithm>

#include "describe/description.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

/// Numbers written anywhere within a node.
std::size_t numbers_in(const toml::node* node) {
  if (!node) return 0;
  if (node->is_number()) return 1;
  std::size_t sum = 0;
  if (const toml::array* array = node->as_array())
    for (const toml::node& element : *array) sum += numbers_in(&element);
  if (const toml::table* table = node->as_table())
    for (const auto& [key, value] : *table) sum += numbers_in(&value);
  return sum;
}

/// The count of the section that a part names, made where it is the first of it.
ShapeNumbers& section_of(const toml::node& part, std::vector<ShapeNumbers>& counts) {
  const toml::table* table = part.as_table();
  const std::string name = table ? (*table)["section"].value_or(std::string()) : std::string();
  const auto known = std::find_if(counts.begin(), counts.end(),
                                  [&](const ShapeNumbers& c) { return c.section == name; });
  if (known != counts.end()) return *known;
  counts.push_back({"", name, 0});
  return counts.back();
}

}  // namespace

std::vector<ShapeNumbers> count_shape_numbers(const toml::table& bone) {
  std::vector<ShapeNumbers> counts;
  for (const char* key : {"add", "cut"})
    if (const toml::array* parts = bone[key].as_array())
      for (const toml::node& part : *parts) section_of(part, counts).numbers += numbers_in(&part);
  const std::size_t shared = numbers_in(bone.get("blend_mm")) + numbers_in(bone.get("clear"));
  for (ShapeNumbers& count : counts) {
    count.bone = bone["name"].value_or(std::string());
    count.numbers += shared;
  }
  return counts;
}

Result<std::vector<ShapeNumbers>> shape_numbers(const std::filesystem::path& description) {
  const auto text = read_file(description, 1 << 22);
  if (!text) return tl::unexpected(text.error());
  const auto anatomy = parse_description(*text, description.string());
  if (!anatomy) return tl::unexpected(anatomy.error());
  std::vector<ShapeNumbers> counts;
  for (const BoneDescription& bone : anatomy->bones)
    counts.insert(counts.end(), bone.shape_numbers.begin(), bone.shape_numbers.end());
  return counts;
}

}  // namespace osteon
