#include "viewer/shaders/group_shaders.h"

#include "sdf/expr/hoist.h"
#include "viewer/shaders/parts.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {
namespace {

// A reading of a group counts as the share of a whole one that its operations are.
std::string defines(double inverse, double share) {
  return define("REST", "sdfDistance(p, vec3(0.0)) * " + number(inverse)) + define("SHARE", number(share));
}

// What every driver has room for, but for some of the camera's.
constexpr std::size_t kMostUniforms = 960;

std::string counts(bool counted) {
  if (!counted) return define("STORE_COUNTS", "");
  return "layout(location = 1) out vec4 counts;\n" +
         define("STORE_COUNTS", "counts = vec4(weight * SHARE * float(readings), 0.0, 0.0, 0.0);");
}

}  // namespace

std::vector<GroupShaders> groupShaders(std::span<const Numbered> operands, double operandsInAll, bool winners,
                                       double inverse, const Box& bounds, const ShaderOptions& options) {
  const std::vector<Group> groups = groupsOf(operands);
  if (groups.size() == 1) return {};
  const auto operations = [](const Expr& e) { return static_cast<double>(topologicalOrder({&e, 1}).size()); };
  double whole = 0.0;
  for (const Group& group : groups) whole += operations(group.distance);
  std::vector<GroupShaders> result;
  for (const Group& group : groups) {
    const Expr read = hoisted(group.distance);
    GlslWriter values;
    const auto source = [&] {
      return header(options.es) + values.source() + defines(inverse, operations(group.distance) / whole) +
             parts::kCamera + parts::kRest;
    };
    values.add("sdfDistance", {&read, 1});
    const std::string cones = source() + farEnd(bounds) + parts::kCones;
    const std::string normal = normals(values, read);
    if (winners) values.add("sdfWinner", {&group.winner, 1});
    if (values.uniformValues({}).size() > kMostUniforms) return {};
    const std::string hits = source() + define("OPERANDS", number(operandsInAll)) +
                             define("WINNER", winners ? "sdfWinner(p, vec3(0.0))" : "0.0") +
                             parts::kNoPlanes + parts::kMarch + normal + counts(options.countReadings) +
                             parts::kFavoured + parts::kHits;
    if (result.empty() || result.back().hits != hits) result.push_back({cones, hits, {}});
    result.back().values.push_back(std::move(values));
  }
  return result;
}

}  // namespace sdf::viewer
