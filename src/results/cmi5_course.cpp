#include "osteon/results/cmi5_course.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr const char* kCourseWhere = "course";

std::string escaped_xml(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        // XML 1.0 has no place for other control characters.
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
  return out;
}

std::string lang_string(const char* element, const std::string& text, const std::string& indent) {
  return indent + "<" + element + "><langstring lang=\"en\">" + escaped_xml(text) +
         "</langstring></" + element + ">\n";
}

// xs:decimal knows no exponent; three digits tell scores apart.
std::string as_decimal(double value) {
  const int thousandths = static_cast<int>(std::lround(1000 * std::clamp(value, 0.0, 1.0)));
  std::string digits = std::to_string(1000 + thousandths % 1000).substr(1);
  return std::to_string(thousandths / 1000) + "." + digits;
}

bool is_address(const std::string& id) {
  const std::size_t colon = id.find(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == id.size()) return false;
  return std::all_of(id.begin(), id.end(), [](unsigned char c) {
    return c > 0x20 && c != 0x7f &&
           std::string("<>\"{}|\\^`").find(static_cast<char>(c)) == std::string::npos;
  });
}

std::string unit_xml(const Cmi5Unit& unit, const Cmi5Course& course) {
  const std::string query = course.seed.empty() ? "" : "?seed=" + course.seed;
  const std::string mastery =
      unit.mastery ? " masteryScore=\"" + as_decimal(*unit.mastery) + "\"" : "";
  return "  <au id=\"" + escaped_xml(course.id + "/" + unit.scenario) + "\" moveOn=\"Passed\"" +
         mastery + " launchMethod=\"OwnWindow\">\n" + lang_string("title", unit.title, "    ") +
         lang_string("description", unit.text, "    ") + "    <url>osteon://launch/" +
         escaped_xml(unit.scenario + query) + "</url>\n  </au>\n";
}

}  // namespace

Result<std::string> cmi5_course_xml(const Cmi5Course& course) {
  if (!is_address(course.id))
    return fail("the course's id '" + course.id + "' is not an address", kCourseWhere,
                "Give one of your own, such as https://school.example/osteon");
  if (course.title.empty()) return fail("the course has no title", kCourseWhere, "Give it one");
  if (course.units.empty())
    return fail("the course has no exercise", kCourseWhere, "See: osteon scenario list");
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<courseStructure "
      "xmlns=\"https://w3id.org/xapi/profiles/cmi5/v1/CourseStructure.xsd\">\n"
      "  <course id=\"" +
      escaped_xml(course.id) + "\">\n" + lang_string("title", course.title, "    ") +
      lang_string("description", course.text.empty() ? course.title : course.text, "    ") +
      "  </course>\n";
  for (const Cmi5Unit& unit : course.units) {
    if (unit.mastery && !std::isfinite(*unit.mastery))
      return fail("the score to pass '" + unit.scenario + "' is not a number", kCourseWhere);
    xml += unit_xml(unit, course);
  }
  return xml + "</courseStructure>\n";
}

}  // namespace osteon
