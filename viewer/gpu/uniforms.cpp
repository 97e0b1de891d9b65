#include "viewer/gpu/uniforms.h"

#include <algorithm>

namespace sdf::viewer {
namespace {

/// The last word of a declarator such as " vec3 from" or " lights[4]".
std::string nameIn(std::string_view declarator) {
  declarator = declarator.substr(0, declarator.find('['));
  const auto last = declarator.find_last_not_of(" \n");
  if (last == std::string_view::npos) return {};
  declarator = declarator.substr(0, last + 1);
  return std::string(declarator.substr(declarator.find_last_of(" \n") + 1));
}

}  // namespace

std::set<std::string> declaredUniforms(std::string_view source) {
  constexpr std::string_view kStart = "uniform ";
  std::set<std::string> names;
  for (std::size_t at = source.find(kStart); at != std::string_view::npos; at = source.find(kStart, at + 1)) {
    const std::size_t line = source.find_last_of('\n', at) + 1;
    if (source.substr(line, at - line).find("//") != std::string_view::npos) continue;
    std::string_view list = source.substr(at + kStart.size());
    list = list.substr(0, list.find(';'));
    while (!list.empty()) {
      const std::size_t comma = std::min(list.find(','), list.size());
      names.insert(nameIn(list.substr(0, comma)));
      list.remove_prefix(std::min(comma + 1, list.size()));
    }
  }
  return names;
}

}  // namespace sdf::viewer
