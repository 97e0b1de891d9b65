// The shaders' fixed parts of the debug views; see ray_parts.h.
#pragma once

namespace sdf::viewer::parts {

/// Declares the colour of debug views where there is nothing.
inline constexpr const char* kNothing = R"(
const vec3 NOTHING = vec3(0.1);
)";

/// Either defines colorOf(ray, spent): what shown(ray, hit) says of the primary hit, or the slice.
inline constexpr const char* kHitColor = R"(
vec3 colorOf(Ray ray, out bool spent) {
  const int bounce = 0;
  Hit hit;
  FIND_HIT
  COUNT_MARCH
  spent = hit.status == BUDGET;
  return shown(ray, hit);
}
)";

inline constexpr const char* kSliceView = R"(
uniform vec3 slicePoint, sliceNormal;
uniform float isolines;  // their spacing

vec3 colorOf(Ray ray, out bool spent) {
  spent = false;
  float t = dot(slicePoint - ray.origin, sliceNormal) / dot(ray.direction, sliceNormal);
  if (!(ray.before + t > 0.0)) return NOTHING;
  float f = sdfDistance(ray.origin + t * ray.direction, vec3(0.0));
  float pixel = 1.5 * pixelRadius * (ray.before + t);
  float phase = f / isolines, off = abs(phase - floor(phase + 0.5)) * isolines;
  vec3 c = (f > 0.0 ? vec3(0.9, 0.6, 0.3) : vec3(0.35, 0.6, 0.95)) * (1.0 - 0.8 * exp(-abs(f) / isolines));
  c *= mix(0.6, 1.0, clamp(off / pixel, 0.0, 1.0));
  return mix(vec3(1.0), c, clamp(abs(f) / (2.0 * pixel), 0.0, 1.0));
}
)";

/// Each defines shown(ray, hit), the colour of a debug view.
inline constexpr const char* kHitsView = R"(
vec3 shown(Ray ray, Hit hit) { return hit.status == MISS ? NOTHING : vec3(1.0); }
)";

inline constexpr const char* kNormalsView = R"(
vec3 shown(Ray ray, Hit hit) {
  if (hit.status == MISS) return NOTHING;
  return 0.5 + 0.5 * hit.normal;
}
)";

inline constexpr const char* kStepsView = R"(
vec3 shown(Ray ray, Hit hit) {
  if (hit.status == BUDGET) return vec3(1.0, 0.0, 1.0);
  float share = log2(1.0 + float(hit.readings)) / log2(1.0 + float(maxSteps));
  return clamp(1.5 - abs(4.0 * share - vec3(3.0, 2.0, 1.0)), 0.0, 1.0);
}
)";

inline constexpr const char* kGradientView = R"(
vec3 shown(Ray ray, Hit hit) {
  if (hit.status == MISS) return NOTHING;
  float off = clamp(length(gradientAt(ray.origin + hit.t * ray.direction)) - 1.0, -1.0, 1.0);
  return vec3(max(off, 0.0), 1.0 - abs(off), max(-off, 0.0));
}
)";

inline constexpr const char* kMaterialView = R"(
vec3 shown(Ray ray, Hit hit) {
  if (hit.status == MISS) return NOTHING;
  float t = hit.t;
  vec3 p = ray.origin + t * ray.direction, d = ray.direction, n = hit.normal;
  float s[ATTRIBUTES];
  FOOTPRINT
  TAKE_OPERAND
  sdfSurface(p, n, s);
  TAKE_LOOK
  return vec3(s[RED], s[GREEN], s[BLUE]);
}
)";

inline constexpr const char* kOcclusionView = R"(
vec3 shown(Ray ray, Hit hit) {
  if (hit.status == MISS) return NOTHING;
  vec3 p = ray.origin + hit.t * ray.direction, n = hit.normal;
  return vec3(OCCLUSION * STEP_OCCLUSION);
}
)";

inline constexpr const char* kShadowView = R"(
vec3 shown(Ray ray, Hit hit) {
  if (hit.status == MISS) return NOTHING;
  vec3 p = ray.origin + hit.t * ray.direction;
  float arrives = 0.0, asked = 0.0;
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 way = lightVector[i].xyz - lightVector[i].w * p;
    float far = length(way), light = lightColor[i].w;
    vec3 l = way / far;
    if (light == 0.0) continue;
    asked += 1.0;
    arrives += arriving(i, p, l, far);
  }
  return vec3(asked > 0.0 ? arrives / asked : 1.0);
}
)";

/// The colours lie evenly between errorLimit on the inner side and on the outer one; the first and the last
/// are those of what is beyond.
inline constexpr const char* kErrorView = R"(
uniform sampler2D hitMark;
uniform vec4 errorColors[ERROR_COLORS];
uniform float errorLimit;

vec3 shown(Ray ray, Hit hit) {
  if (hit.status == MISS) return NOTHING;
  float share = texelFetch(hitMark, ivec2(gl_FragCoord.xy), 0).y / errorLimit;
  float place = 1.0 + 0.5 * (clamp(share, -1.0, 1.0) + 1.0) * float(ERROR_COLORS - 3);
  int below = min(int(place), ERROR_COLORS - 3);
  vec3 color = mix(errorColors[below].rgb, errorColors[below + 1].rgb, place - float(below));
  if (share < -1.0) color = errorColors[0].rgb;
  if (share > 1.0) color = errorColors[ERROR_COLORS - 1].rgb;
  return color * (0.55 + 0.45 * abs(dot(hit.normal, ray.direction)));
}
)";

}  // namespace sdf::viewer::parts
