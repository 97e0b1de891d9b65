#include "viewer/shaders/parts.h"

namespace sdf::viewer::parts {

// A ray's t is counted from a plane `ahead` picture distances before the eye: far from the scene, positions
// near it would otherwise be rounded to steps of the eye's distance. `from` lies on that plane.
const char* const kCamera = R"(
uniform vec2 size;            // of the picture, pixels
uniform vec3 from, right, up;
uniform vec3 forward;         // as long as the picture plane is far away, in picture heights
uniform float ahead;          // of the eye, where t = 0: in lengths of `forward`
uniform float maxDistance;    // from the eye
uniform float pixelRadius;    // of a pixel's cone at distance 1
uniform float epsilon;        // least distance that counts as a hit
uniform float threshold;      // share of the pixel's cone that does
uniform int maxSteps;
uniform vec2 within;          // where in its pixel a sample is
uniform float weight;         // its share of the pixel: less than 1 if linear colours are to be summed up

struct Ray {
  vec3 origin, direction;
  float before;               // distance from the eye to t = 0
  float start, end;           // t between which alone it may meet more than planes
  float reach;                // t up to which it is followed
};

const int MISS = 0, HIT = 1, BUDGET = 2;  // what becomes of a ray

Ray rayThrough(vec2 pixel) {
  vec2 uv = (pixel - 0.5 * size) / size.y;
  vec3 across = uv.x * right + uv.y * up, way = across + forward;
  float far = length(way);
  return Ray(from + ahead * across, way / far, ahead * far, 0.0, 1e30, maxDistance - ahead * far);
}

// How near a surface counts as hit at t.
float hitDistance(Ray ray, float t) { return epsilon + threshold * pixelRadius * (ray.before + t); }
)";

const char* const kField = R"(
float field(vec3 p) { return sdfDistance(p, vec3(0.0)) * INVERSE_SLOPE; }
)";

const char* const kRest = R"(
float rest(vec3 p) { return REST; }
)";

const char* const kPlanes = R"(
// Where the ray enters the first of the half spaces.
float planesFrom(Ray ray) {
  float planes[PLANES], nearest = 1e30;
  sdfPlanes(ray.origin, ray.direction, planes);
  for (int i = 0; i < PLANES; i += 2) {
    float height = planes[i], fall = -planes[i + 1];  // height falls by so much a unit
    if (height <= 0.0) return 0.0;
    if (fall > 0.0) nearest = min(nearest, height / fall);
  }
  return nearest;
}
)";

const char* const kNoPlanes = R"(
float planesFrom(Ray ray) { return 1e30; }
)";

// Only what is nearer to the ray than t / k dims the light: within the rest's bounds grown by the most of
// that, and within a ball around them that grows with t, |p + t l - c| < R + t / k.
const char* const kShadowSpan = R"(
void clip(vec3 p, vec3 l, float widening, inout float t, inout float reach) {
  float grown = reach * widening;
  vec3 low = (BOX_MIN - grown - p) / l, high = (BOX_MAX + grown - p) / l;
  vec3 enter = min(low, high), leave = max(low, high);
  vec3 away = p - 0.5 * (BOX_MIN + BOX_MAX);
  float radius = 0.5 * length(BOX_MAX - BOX_MIN);
  float a = 1.0 - widening * widening, b = dot(away, l) - radius * widening;
  float root = b * b - a * (dot(away, away) - radius * radius);
  reach = root > 0.0 ? min(min(reach, (sqrt(root) - b) / a), min(leave.x, min(leave.y, leave.z))) : 0.0;
  t = max(max(t, (-sqrt(max(root, 0.0)) - b) / a), max(enter.x, max(enter.y, enter.z)));
}
)";

const char* const kNoShadowSpan = R"(
void clip(vec3 p, vec3 l, float widening, inout float t, inout float reach) {}
)";

// height / t falls with t, so it is least at the end; below 0 the light is behind the plane.
const char* const kPlanesLight = R"(
float leastOfPlanes(vec3 p, vec3 l, float reach) {
  float planes[PLANES], least = 1.0;
  sdfPlanes(p, l, planes);
  for (int i = 0; i < PLANES; i += 2) least = min(least, max(planes[i], 0.0) / reach + planes[i + 1]);
  return least;
}
)";

const char* const kNoPlanesLight = R"(
float leastOfPlanes(vec3 p, vec3 l, float reach) { return 1.0; }
)";

const char* const kHit = R"(
// What a ray meets. Marching and the layers that hit passes write both fill it.
struct Hit {
  int status;     // MISS, HIT or BUDGET
  float t;
  vec3 normal;
  float operand;  // number of the union's operand that is met
  int readings;   // of the distance, by the march
};
)";

const char* const kMarch = R"(
float march(Ray ray, out int status, out int readings) {
  float r = 0.0, z = 0.0, slope = -1.0, t = ray.start, plane = planesFrom(ray);
  bool ends = plane < ray.reach;  // in a plane
  float tMax = min(plane, ray.reach);
  status = BUDGET;
  readings = 0;
  if (t >= tMax) {  // the cone pass saw nothing
    status = ends ? HIT : MISS;
    return tMax;
  }
  while (readings < maxSteps) {
    float next = rest(ray.origin + (t + z) * ray.direction);
    ++readings;
    if (z > r && z > r + next) {  // the balls do not overlap: something may lie between
      z = r;
      slope = -1.0;
      continue;
    }
    if (z > 0.0) slope += 0.3 * ((next - r) / z - slope);
    t += z;
    float near = hitDistance(ray, t);
    if (next <= near) {
      if (z > 0.0 && next < r) t += clamp(next * z / (r - next), -z, 4.0 * near);  // where the secant meets 0
      status = HIT;
      return t;
    }
    r = next;
    if (t + r >= min(tMax, ray.end)) {
      status = ends ? HIT : MISS;
      return tMax;
    }
    z = STEP;
  }
  return t;
}
)";

const char* const kMeet = R"(
Hit meet(Ray ray) {
  Hit hit;
  hit.t = march(ray, hit.status, hit.readings);
  vec3 p = ray.origin + hit.t * ray.direction;
  hit.normal = normalAt(p, ray.direction);
  hit.operand = OPERAND;
  return hit;
}
)";

const char* const kGradient = R"(
vec3 gradientAt(vec3 p) { return sdfGradient(p, vec3(0.0)); }
)";

// Four corners of a cube: Evans 2006; written as a loop, so that the distance is inlined once.
const char* const kGradientByTaps = R"(
vec3 gradientAt(vec3 p) {
  float h = 1e-4 * max(1.0, max(abs(p.x), max(abs(p.y), abs(p.z))));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 corner = vec3(float(((i + 3) >> 1) & 1), float((i >> 1) & 1), float(i & 1)) * 2.0 - 1.0;
    sum += corner * sdfDistance(p + h * corner, vec3(0.0));
  }
  return 0.25 / h * sum;
}
)";

const char* const kFootprint = R"(
uniform float footprint;  // a sample's share of the picture, as wide as this at distance 1; 0: sharp patterns

void setFootprint(vec3 n, vec3 d, float distance) {
  float facing = dot(n, d);
  pixelWay = d / (facing < 0.0 ? min(facing, -1e-4) : max(facing, 1e-4));
  pixelSize = footprint * distance;
}
)";

const char* const kNormal = R"(
vec3 normalAt(vec3 p, vec3 d) {
  vec3 g = gradientAt(p);
  float far = length(g);
  return far > 0.0 ? g / far : -d;
}
)";

const char* const kShadowSettings = R"(
uniform float shadowStart, shadowReach, shadowHit, sharpness;
uniform int shadowSteps;
)";

const char* const kHardShadow = R"(
float shadow(vec3 p, vec3 l, float reach) {
  float t = shadowStart;
  if (leastOfPlanes(p, l, reach) <= 0.0) return 0.0;
  clip(p, l, 0.0, t, reach);
  for (int i = 0; i < shadowSteps && t < reach; ++i) {
    float g = rest(p + t * l);
    COUNT_SHADOW
    if (g <= shadowHit) return 0.0;
    t += g;
  }
  return 1.0;
}
)";

const char* const kSoftShadow = R"(
float shadow(vec3 p, vec3 l, float reach) {
  float t = shadowStart, light = clamp(sharpness * leastOfPlanes(p, l, reach), 0.0, 1.0);
  if (light == 0.0) return 0.0;
  clip(p, l, min(1.0 / sharpness, 0.9), t, reach);
  for (int i = 0; i < shadowSteps && t < reach; ++i) {
    float g = rest(p + t * l);
    COUNT_SHADOW
    if (g <= shadowHit) return 0.0;
    light = min(light, sharpness * g / t);
    t += g;
  }
  return light;
}
)";

const char* const kImprovedShadow = R"(
float shadow(vec3 p, vec3 l, float reach) {
  float t = shadowStart, light = 1.0, step = 0.0, before = 0.0;
  for (int i = 0; i < shadowSteps; ++i) {
    float g = field(p + t * l);
    COUNT_SHADOW
    if (g <= shadowHit) return 0.0;
    float y = step > 0.0 ? (step * step + g * g - before * before) / (2.0 * step) : 0.0;
    float d = step > 0.0 ? sqrt(max(0.0, g * g - y * y)) : g;
    if (t - y > 0.0) light = min(light, sharpness * d / (t - y));
    step = before = g;
    t += g;
    if (t >= reach) break;
  }
  return light;
}
)";

const char* const kSignedShadow = R"(
float shadow(vec3 p, vec3 l, float reach) {
  float t = shadowStart, x = 1.0;
  for (int i = 0; i < shadowSteps; ++i) {
    float g = field(p + t * l);
    COUNT_SHADOW
    x = min(x, sharpness * g / t);
    if (x <= -1.0) return 0.0;
    t += max(abs(g), shadowHit);
    if (t >= reach) break;
  }
  return 0.25 * (1.0 + x) * (1.0 + x) * (2.0 - x);
}
)";

const char* const kOcclusionTaps = R"(
uniform float tapSpacing, tapStrength;

float occlusion(vec3 p, vec3 n) {
  float closed = 0.0;
  for (int i = 1; i <= TAPS; ++i) {
    float h = tapSpacing * float(i);
    closed += (h - field(p + h * n)) / h;
    COUNT_OCCLUSION
  }
  return clamp(1.0 - tapStrength * closed, 0.0, 1.0);
}
)";

const char* const kOcclusionSteps = R"(
uniform float tapStrength;
)";

const char* const kLightSettings = R"(
uniform vec4 lightVector[LIGHTS];  // xyz: towards the light, of length 1, if w is 0; its position if w is 1
uniform vec4 lightColor[LIGHTS];   // times its intensity; w: 1 if it casts shadows
)";

const char* const kLights = R"(
vec3 direct(vec3 p, vec3 n, vec3 d, float s[ATTRIBUTES]) {
  vec3 sum = vec3(0.0);
  vec3 diffuse = vec3(s[RED], s[GREEN], s[BLUE]), specular = vec3(s[SPECULAR_RED], s[SPECULAR_GREEN], s[SPECULAR_BLUE]);
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 way = lightVector[i].xyz - lightVector[i].w * p;
    float far = length(way), cosine = dot(n, way) / far;
    vec3 l = way / far;
    float gloss = max(dot(2.0 * cosine * n - l, -d), 0.0);
    float highlight = gloss > 0.0 ? pow(gloss, s[SHININESS]) : (s[SHININESS] > 0.0 ? 0.0 : 1.0);
    vec3 light = diffuse * max(cosine, 0.0) + specular * highlight;
    if (light == vec3(0.0)) continue;
    SHADE_LIGHT
    sum += lightColor[i].rgb * light;
  }
  return sum;
}
)";

const char* const kHitFromLayers = R"(
uniform sampler2D hitSurface, hitIdentity;

Hit primaryHit() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(hitSurface, pixel, 0);
  vec2 identity = texelFetch(hitIdentity, pixel, 0).xy;
  return Hit(int(identity.y), surface.w, surface.xyz, identity.x, 0);
}
)";

const char* const kRadiance = R"(
uniform vec3 ambient;
uniform vec3 fogColor;
uniform float fogDensity;

vec3 colorOf(Ray ray, out bool spent) {
  vec3 total = vec3(0.0), through = vec3(1.0);
  spent = false;
  for (int bounce = 0; bounce <= BOUNCES; ++bounce) {
    Hit hit;
    FIND_HIT
    COUNT_MARCH
    if (hit.status == MISS) {
      total += through * sdfBackground(ray.direction, vec3(0.0));
      break;
    }
    if (hit.status == BUDGET) spent = true;
    float t = hit.t;
    vec3 p = ray.origin + t * ray.direction, d = ray.direction, n = hit.normal;
    float s[ATTRIBUTES];
    FOOTPRINT
    TAKE_OPERAND
    sdfSurface(p, n, s);
    vec3 local = ambient * vec3(s[AMBIENT_RED], s[AMBIENT_GREEN], s[AMBIENT_BLUE]) * OCCLUSION;
    local += DIRECT + vec3(s[EMISSION_RED], s[EMISSION_GREEN], s[EMISSION_BLUE]);
    local *= STEP_OCCLUSION;
    float clear = exp(-fogDensity * (bounce == 0 ? ray.before + t : t)), mirror = 0.0;
#if BOUNCES > 0
    if (bounce < BOUNCES && s[REFLECTIVITY] > 0.0) {
      float edge = 1.0 - max(dot(-d, n), 0.0);
      float rim = s[FRESNEL_POWER] == 0.0 ? 1.0 : pow(edge, s[FRESNEL_POWER]);
      mirror = min(s[REFLECTIVITY] * (s[FRESNEL_BIAS] + rim), 1.0);
    }
#endif
    total += through * mix(fogColor, (1.0 - mirror) * local, clear);
    through *= clear * mirror;
    if (max(through.r, max(through.g, through.b)) < 1.0 / 1024.0) break;
    float off = 2.0 * hitDistance(ray, t);
    ray = Ray(p + off * n, reflect(d, n), ray.before + t, 0.0, 1e30, maxDistance);
  }
  return total;
}
)";

const char* const kSrgb = R"(
vec3 encode(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
)";

const char* const kPicture = R"(
layout(location = 0) out vec4 color;  // alpha is 0 where a ray ran out of steps

void main() {
  sdfTakeValues();
  Ray ray = rayThrough(floor(gl_FragCoord.xy) + within);
  START_RAY
  bool spent;
  vec3 c = colorOf(ray, spent);
  color = vec4(weight < 1.0 ? weight * c : ENCODE(c), spent ? 0.0 : weight);
  STORE_COUNTS
}
)";

const char* const kResolve = R"(
uniform sampler2D sums;
uniform float weight;
layout(location = 0) out vec4 color;

void main() {
  vec4 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
  color = vec4(ENCODE(sum.rgb), sum.a > 1.0 - 0.5 * weight ? 1.0 : 0.0);
}
)";

const char* const kBackground = R"(
vec3 colorOf(Ray ray, out bool spent) {
  spent = false;
  return sdfBackground(ray.direction, vec3(0.0));
}
)";

// Two rays through one tile are no farther apart at equal t than their pixels' distance times
// (ahead + t / |forward|): what the ball around the tile's middle ray leaves of that is free for both.
const char* const kCones = R"(
uniform sampler2D coarser;  // starts of tiles four times as large; not read at the first level
uniform bool first;
uniform float tile;         // its side in pixels
uniform vec2 corner;        // of the first tile, in the target
layout(location = 0) out vec4 start;

void main() {
  sdfTakeValues();
  Ray ray = rayThrough((floor(gl_FragCoord.xy - corner) + 0.5) * tile);
  float spread = 0.7072 * tile / size.y, widening = spread / length(forward);
  vec3 span = first ? vec3(0.0, 0.0, farEnd(ray, spread, widening)) : texelFetch(coarser, ivec2(gl_FragCoord.xy) / 4, 0).rgb;
  float t = span.x, end = span.z;
  bool back = false;  // from the end
  int readings = 0;
  while (readings < 64) {
    if (!back && t >= end) {
      t = maxDistance;
      break;
    }
    float at = back ? end : t, wide = spread * ahead + widening * at;
    float free = rest(ray.origin + at * ray.direction) - wide;
    ++readings;
    if (free <= (1.0 + widening) * (0.25 * wide + epsilon)) {
      if (back || !first) break;
      back = true;
    } else if (back) {
      if (!(end - free > t)) break;  // something is at t: so far off this distance is not to be trusted
      end -= free;
    } else {
      t += free / (1.0 + widening);
    }
  }
  start = vec4(t, SHARE * float(readings), end, 0.0);
}
)";

const char* const kStarts = R"(
uniform sampler2D starts;
uniform vec2 corner;  // of this pass's starts, in their texture
uniform float tile;   // that has one start, pixels

void startRay(inout Ray ray) {
  vec2 span = texelFetch(starts, ivec2(corner + floor(gl_FragCoord.xy / tile)), 0).rb;
  ray.start = span.x;
  ray.end = span.y;
}
)";

const char* const kHitCounts = R"(
layout(location = 2) out vec4 counts;
)";

const char* const kPictureCounts = R"(
layout(location = 1) out vec4 counts;
vec4 counted = vec4(0.0);
)";

const char* const kHits = R"(
layout(location = 0) out vec4 hitSurface;   // the normal, and t
layout(location = 1) out vec2 hitIdentity;  // the operand, and the status

// Of two operands that are hit at once the later shows: t less a hair that grows with the operand's number, within a
// quarter of how far off a ray may be when it hits.
float favoured(Ray ray, Hit hit) { return hit.t - 0.25 * hitDistance(ray, hit.t) * (hit.operand + 1.0) / OPERANDS; }

void main() {
  sdfTakeValues();
  Ray ray = rayThrough(floor(gl_FragCoord.xy) + within);
  START_RAY
  Hit hit = meet(ray);
  hitSurface = vec4(hit.normal, hit.t);
  hitIdentity = vec2(hit.operand, float(hit.status));
  gl_FragDepth = hit.status == MISS ? 1.0 : favoured(ray, hit) / maxDistance;
  STORE_COUNTS
}
)";

std::span<const char* const> all() {
  // clang-format off
  static const char* const kAll[] = {
      kCamera, kHit, kField, kRest, kPlanes, kNoPlanes, kMarch, kGradient, kGradientByTaps, kNormal, kMeet,
      kStarts, kHitCounts, kPictureCounts, kCones, kHits, kHitFromLayers, kFootprint, kShadowSpan,
      kNoShadowSpan, kPlanesLight, kNoPlanesLight, kShadowSettings, kHardShadow, kSoftShadow,
      kImprovedShadow, kSignedShadow, kOcclusionTaps, kOcclusionSteps, kLightSettings, kLights, kRadiance,
      kBackground, kSliceView, kHitColor, kHitsView, kNormalsView, kStepsView, kGradientView,
      kMaterialView, kOcclusionView, kShadowView, kNothing, kSrgb, kPicture, kResolve};
  // clang-format on
  return kAll;
}

}  // namespace sdf::viewer::parts
