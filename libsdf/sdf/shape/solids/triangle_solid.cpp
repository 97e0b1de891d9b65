#include "sdf/shape/solids/triangle_solid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/base/srgb.h"
#include "sdf/shape/solids/placed.h"

namespace sdf {
namespace {

glm::dvec3 texel(const TextureImage& image, const glm::dvec2& at) {
  if (image.width < 1 || image.height < 1) return glm::dvec3(1.0);
  const auto place = [](double x, int size) {
    return std::clamp(static_cast<int>((x - std::floor(x)) * size), 0, size - 1);
  };
  const std::size_t i =
      4 * (static_cast<std::size_t>(place(at.y, image.height)) * image.width + place(at.x, image.width));
  const auto linear = [&](std::size_t k) { return linearOf(image.pixels[i + k] / 255.0); };
  return {linear(0), linear(1), linear(2)};
}

glm::dvec3 colorOf(const TriangleMesh& mesh, const glm::uvec3& t, const TriangleMaterial& material) {
  glm::dvec3 color(material.color);
  glm::dvec2 at(0.0);
  glm::dvec3 tint(0.0);
  for (int k = 0; k < 3; ++k) {
    if (!mesh.colors.empty()) tint += glm::dvec3(mesh.colors[t[k]]) / 3.0;
    if (!mesh.textureAt.empty()) at += glm::dvec2(mesh.textureAt[t[k]]) / 3.0;
  }
  if (!mesh.colors.empty()) color *= tint;
  if (material.colorTexture >= 0 && !mesh.textureAt.empty())
    color *= texel(mesh.images[static_cast<std::size_t>(material.colorTexture)], at);
  return color;
}

Vec3E constant(const glm::dvec3& v) { return {Expr(v.x), Expr(v.y), Expr(v.z)}; }

}  // namespace

Material meanMaterial(const TriangleMesh& mesh) {
  glm::dvec3 color(0.0), emission(0.0);
  double metallic = 0.0, roughness = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const TriangleMaterial& material = mesh.materials[mesh.materialOf.empty() ? 0 : mesh.materialOf[i]];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const double area = glm::length(glm::cross(b - a, c - a));
    color += area * colorOf(mesh, t, material);
    emission += area * glm::dvec3(material.emission);
    metallic += area * material.metallic, roughness += area * material.roughness;
    sum += area;
  }
  if (!(sum > 0.0)) return {};
  color /= sum, metallic /= sum, roughness /= sum;
  constexpr double kDielectric = 0.04, kSmoothest = 0.05, kBlinn = 4.0;  // exponents by Phong's
  const double exponent = 0.5 * (1.0 / std::pow(std::max(roughness, kSmoothest), 4.0) - 1.0);
  const glm::dvec3 straight = glm::mix(glm::dvec3(kDielectric), color, metallic);
  const double most = std::max({straight.x, straight.y, straight.z});
  const glm::dvec3 specular =
      straight * std::min((kBlinn * exponent + 2.0) / 8.0, 1.0 / std::max(most, 1e-9));
  const double mirror = metallic * (1.0 - roughness);
  return {.color = constant(color * (1.0 - mirror)),
          .specular = constant(specular),
          .shininess = exponent,
          .reflectivity = mirror,
          .fresnelPower = 5.0,
          .fresnelBias = most,
          .emission = constant(emission / sum)};
}

std::optional<PlacedMesh> placedMesh(Expr f) {
  f = withoutFactor(f);
  const PayloadPart* part = f.payloadPart();
  if (!part || part->part != 0) return {};
  auto field = std::dynamic_pointer_cast<const MeshField>(part->payload);
  if (!field) return {};
  PlacedMesh placed{std::move(field), {f.arg(0), f.arg(1), f.arg(2)}};
  if (!std::ranges::all_of(placed.at, isLinear)) return {};
  return placed;
}

bool hasOwnMaterial(const Shape& shape, const MeshField& field) {
  const Attributes own = attributesOf(meanMaterial(field.mesh()));
  constexpr auto kId = static_cast<std::size_t>(Attribute::MaterialId);
  return std::equal(own.begin(), own.begin() + kId, shape.surface.begin());
}

Shape triangleSolid(const std::shared_ptr<const MeshField>& field) {
  const TriangleDistance& distance = field->distance();
  const Vec3E p = position();
  Shape s;
  s.distance = Expr::payload({field}, {p.x, p.y, p.z});
  s.bounds = {distance.min(), distance.max()};
  s.claim = {distance.signBy() == SignBy::Normals ? ClaimKind::Exact : ClaimKind::Bound, 1.0, 1.0};
  return s.paint(meanMaterial(field->mesh()));
}

}  // namespace sdf
