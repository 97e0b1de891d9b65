// The shaders' fixed parts that find what rays meet, in the order in which they are put together; those of
// light and of the debug views follow. A part uses functions of those before it, uniforms that it or these
// declare, and macros, which are the words in capitals.
#pragma once

namespace sdf::viewer::parts {

/// Declares the frame's uniforms and a Ray, and defines rayThrough(pixel) and hitDistance(ray, t).
/// A ray's t is counted from a plane `ahead` picture distances before the eye: far from the scene, positions
/// near it would otherwise be rounded to steps of the eye's distance. `from` lies on that plane.
inline constexpr const char* kCamera = R"(
uniform vec2 size;            // of the picture, pixels
uniform vec3 from, right, up;
uniform vec3 forward;         // as long as the picture plane is far away, in picture heights
uniform float ahead;          // of the eye, where t = 0: in lengths of `forward`
uniform float maxDistance;    // from the eye
uniform float unit;           // a length of the scene's size, where the camera is fitted to it
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
const int DRAWN = 3;                      // or a hit that looks as hitLook and hitGlow say,
const int MESHED = 4;                     // or as they and the mesh's materials do

Ray rayThrough(vec2 pixel) {
  vec2 uv = (pixel - 0.5 * size) / size.y;
  vec3 across = uv.x * right + uv.y * up, way = across + forward;
  float far = length(way);
  return Ray(from + ahead * across, way / far, ahead * far, 0.0, 1e30, maxDistance - ahead * far);
}

// How near a surface counts as hit at t.
float hitDistance(Ray ray, float t) { return epsilon + threshold * pixelRadius * (ray.before + t); }
)";

/// Declares a Hit: what a ray meets. Every way to find it fills this struct, and every use of it reads it.
inline constexpr const char* kHit = R"(
// What a ray meets. Marching and the layers that hit passes write both fill it.
struct Hit {
  int status;     // MISS, HIT or BUDGET
  float t;
  vec3 normal;
  float operand;  // number of the union's operand that is met
  int readings;   // of the distance, by the march
};
)";

/// Defines field(p) of the whole: x, how far one may go, the radius of a ball around p that is free of the
/// surface; y, how far it is.
inline constexpr const char* kField = R"(
vec2 field(vec3 p) { return FIELD; }
)";

/// Defines rest(p, enough), the same for what is marched, without half spaces and balls; where both are at
/// least `enough` they may be less than they are, but no less than that.
inline constexpr const char* kRest = R"(
vec2 rest(vec3 p, float enough) { return REST; }
)";

/// The same of a box.
inline constexpr const char* kRestByBox = R"(
uniform vec3 boxMiddle, boxHalf;

vec2 rest(vec3 p, float enough) {
  vec3 gap = abs(p - boxMiddle) - boxHalf;
  return vec2(length(max(gap, 0.0)) + min(max(gap.x, max(gap.y, gap.z)), 0.0));
}
)";

/// Either defines planesFrom(ray), the t at which a ray enters the first of the half spaces.
inline constexpr const char* kPlanes = R"(
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

inline constexpr const char* kNoPlanes = R"(
float planesFrom(Ray ray) { return 1e30; }
)";

/// Defines ballsFrom(origin, direction, nearest), the least of that and the t at which the ray enters a ball.
/// How far the ray passes by the middle is read from the vector between: as a difference of squares it would
/// be rounded to that of the whole way (Haines, Guenther, Akenine-Moeller, "Precision improvements for
/// ray/sphere intersection", 2019).
inline constexpr const char* kBalls = R"(
float ballsFrom(vec3 origin, vec3 direction, float nearest) {
  float balls[BALLS];
  sdfBalls(vec3(0.0), vec3(0.0), balls);
  for (int i = 0; i < BALLS; i += 4) {
    vec3 way = vec3(balls[i], balls[i + 1], balls[i + 2]) - origin;
    float middle = dot(way, direction);
    vec3 by = way - middle * direction;
    float root = balls[i + 3] - dot(by, by), deep = sqrt(max(root, 0.0));
    if (root > 0.0 && middle + deep > 0.0) nearest = min(nearest, max(middle - deep, 0.0));
  }
  return nearest;
}
)";

/// Either defines march(ray, status, readings), the t at which a ray hits the rest, or what SOLVED finds: a
/// half space or a ball. Near the surface the last slope says where it is. The ray hits if a reading behind
/// that place lies in the solid: then it passes neither by an edge nor through a film of no thickness, where
/// a cut ends in a face. sdf/march/march.h states it in full. A hit is as near as the slopes on both sides
/// place it, and a hair nearer, since on the surface some distances have no gradient. With MOST_CLOSE
/// readings near the surface, of which rising ones count for an eighth, a ray hits, for it goes along a face
/// or an edge. Where distances are read LOOSE, as less than they are, a ray that nears a surface slowly or
/// leaves it may have a long way to go there: it goes a pixel at a time, and all readings but level ones
/// count for an eighth. Slopes then tell little of where the surface is: it is narrowed down by signs.
inline constexpr const char* kMarch = R"(
// Where between t and t + z, with the readings a > 0 and b <= 0, the surface is: up to `least`, by false
// position where that narrows it at least as fast as halving (Oliveira and Takahashi 2020).
float between(Ray ray, float t, float z, float a, float b, float least, inout int readings) {
  float start = 0.0, end = z;
  for (float most = z; end - start > least; most *= 0.5) {
    float middle = 0.5 * (start + end), width = end - start, line = mix(start, end, a / (a - b)), aside = middle - line;
    float there = line + sign(aside) * min(0.2 * width * width / z, abs(aside));
    float may = max(most - 0.5 * width, 0.0);
    there = clamp(there, middle - may, middle + may);
    float value = rest(ray.origin + (t + there) * ray.direction, 0.0).x;
    ++readings;
    if (value > 0.0) start = there, a = value;
    else end = there, b = value;
  }
  return start;
}

const int MOST_CLOSE = 64;
const int FREE = 0, BEHIND = 1, ONTO = 2, ALONG = 3;  // where the next reading is, of the surface

float march(Ray ray, out int status, out int readings) {
  float r = 0.0, z = 0.0, slope = -1.0, fall = 1.0, near = 0.0, t = ray.start, solved = SOLVED;
  bool ends = solved < ray.reach;  // in what is solved
  float tMax = min(solved, ray.reach);
  int step = FREE, close = 0;
  status = BUDGET;
  readings = 0;
  if (t >= tMax) {  // the cone pass saw nothing
    status = ends ? HIT : MISS;
    return tMax;
  }
  while (readings < maxSteps) {
    vec2 both = rest(ray.origin + (t + z) * ray.direction, 0.0);
    float next = both.x;
    ++readings;
    bool inside = (step == BEHIND || step == ALONG) && next <= 0.0;
    bool crosses = LOOSE && r > 0.0 && next <= 0.0 && (step == ONTO || z <= r);
    if (crosses || inside && z <= 8.0 * near) {
      status = HIT;
      if (LOOSE && r > 0.0) return min(t + between(ray, t, z, r, next, near / 512.0, readings), tMax);
      return min(t + max(0.0, 4095.0 / 4096.0 * min(0.8 * z, z * r / (r - next))), tMax);
    }
    // The balls do not overlap: something may lie between.
    bool passes = step == ALONG || step == BEHIND && r <= epsilon || step == ONTO && next < r;
    if (inside || z > r && z > r + next && !passes) {
      step = step == BEHIND ? ONTO : FREE;
      z = step == ONTO ? r / fall : r;
      slope = -1.0;
      continue;
    }
    float rise = z > 0.0 ? (next - r) / z : -1.0;
    if (z > 0.0) slope += 0.3 * (rise - slope);
    t += z;
    r = next;
    float far = max(r, both.y);
    near = hitDistance(ray, t);
    if (far <= near) close += (LOOSE ? rise == 0.0 : rise <= 0.0) ? 8 : 1;
    if (r < (rise < 0.0 ? -near : 0.0) || close > 8 * MOST_CLOSE) {
      status = HIT;
      return t;
    }
    if (t + r >= min(tMax, ray.end)) {
      status = ends ? HIT : MISS;
      return tMax;
    }
    float pixel = 8.0 * near, behind = 1.25 * max(r, epsilon);
    step = far <= 2.0 * near && rise < 0.0 ? BEHIND : LOOSE && far <= near ? ALONG : FREE;
    fall = max(-rise, LOOSE ? min(0.0625, behind / pixel) : 0.0625);
    z = step == BEHIND ? behind / fall : step == ALONG ? pixel : STEP;
  }
  return t;
}
)";

inline constexpr const char* kNoMarch = R"(
float march(Ray ray, out int status, out int readings) {
  float t = SOLVED;
  status = t < ray.reach ? HIT : MISS;
  readings = 0;
  return min(t, ray.reach);
}
)";

/// Either defines gradientAt(p): exactly, that of the operand which is the nearest there, or by differences
/// where the gradient is too long a program.
inline constexpr const char* kGradient = R"(
vec3 gradientAt(vec3 p) { return sdfGradient(p, vec3(0.0)); }
)";

inline constexpr const char* kGradientOfNearest = R"(
float nearestOperand = 0.0;  // of the last gradient

vec3 gradientAt(vec3 p) {
  vec4 both = sdfNearest(p);
  nearestOperand = both.w;
  return both.xyz;
}
)";

/// Four corners of a cube: Evans 2006; written as a loop, so that the distance is inlined once.
inline constexpr const char* kGradientByTaps = R"(
vec3 gradientAt(vec3 p) {
  float h = 1e-4 * max(unit, max(abs(p.x), max(abs(p.y), abs(p.z))));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 corner = vec3(float(((i + 3) >> 1) & 1), float((i >> 1) & 1), float(i & 1)) * 2.0 - 1.0;
    sum += corner * DISTANCE_UP_TO(p + h * corner, 0.0);
  }
  return 0.25 / h * sum;
}
)";

/// Defines normalAt(p, d), where d is the direction of the ray. It reads the gradient some roundings before
/// the surface: on it that of a root vanishes.
inline constexpr const char* kNormal = R"(
vec3 normalAt(vec3 p, vec3 d) {
  vec3 g = gradientAt(p - 2e-6 * max(unit, max(abs(p.x), max(abs(p.y), abs(p.z)))) * d);
  float far = length(g);
  return far > 0.0 ? g / far : -d;
}
)";

/// Defines meet(ray), the Hit of a ray that is marched.
inline constexpr const char* kMeet = R"(
Hit meet(Ray ray) {
  Hit hit = Hit(MISS, 0.0, vec3(0.0), 0.0, 0);
  hit.t = march(ray, hit.status, hit.readings);
  if (hit.status == MISS) return hit;  // nothing is read there, which may take long
  vec3 p = ray.origin + hit.t * ray.direction;
  hit.normal = normalAt(p, ray.direction);
  hit.operand = OPERAND;
  return hit;
}
)";

/// Defines startRay(ray), which lets a primary ray start and end where the cone pass says, or a hull: t where
/// it enters, readings that this took, -t where it ends, and t where it leaves, if a ray begins within.
inline constexpr const char* kRayStarts = R"(
uniform sampler2D starts;
uniform vec2 corner;  // of this pass's starts, in their texture
uniform float tile;   // that has one start, pixels

void startRay(inout Ray ray) {
  vec4 span = texelFetch(starts, ivec2(corner + floor(gl_FragCoord.xy / tile)), 0);
  ray.start = span.a < span.r ? 0.0 : span.r;
  ray.end = -span.b;
}
)";

/// Either declares the output of readings, of a hit pass or of the picture.
inline constexpr const char* kHitCounts = R"(
layout(location = 2) out vec4 counts;
)";

inline constexpr const char* kPictureCounts = R"(
layout(location = 1) out vec4 counts;
vec4 counted = vec4(0.0);
)";

/// Defines main() of the cone pass, beside farEnd(ray, spread, widening) from hit_shaders.cpp.
/// Where it sees nothing the target may keep what it holds, an infinite start.
/// Two rays through one tile are no farther apart at equal t than their pixels' distance times
/// (ahead + t / |forward|): what the ball around the tile's middle ray leaves of that is free for both.
inline constexpr const char* kCones = R"(
uniform sampler2D coarser;  // starts of tiles four times as large; not read at the first level
uniform bool first;
uniform float tile;         // its side in pixels
uniform vec2 corner;        // of the first tile, in the target
layout(location = 0) out vec4 start;

void main() {
  sdfTakeValues();
  TAKE_ROW
  Ray ray = rayThrough((floor(gl_FragCoord.xy - corner) + 0.5) * tile);
  float spread = 0.7072 * tile / size.y, widening = spread / length(forward);
  vec3 span = first ? vec3(0.0, 0.0, farEnd(ray, spread, widening)) : texelFetch(coarser, ivec2(gl_FragCoord.xy) / 4, 0).rgb;
  float t = span.x, end = first ? span.z : -span.z;
  bool back = false;  // from the end
  int readings = 0;
  while (readings < 64) {
    if (!back && t >= end) {
      t = maxDistance;
      break;
    }
    float at = back ? end : t, wide = spread * ahead + widening * at;
    float free = rest(ray.origin + at * ray.direction, 0.0).x - wide;
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
  LEAVE_NOTHING
  start = vec4(t, SHARE * float(readings), -end, 1e30);
}
)";

/// Defines favoured(ray, hit), the t by which hits are sorted.
inline constexpr const char* kFavoured = R"(
// Of two operands that are hit at once the later shows: t less a hair that grows with the operand's number, up to how
// far off a ray may be when it hits.
float favoured(Ray ray, Hit hit) { return hit.t - hitDistance(ray, hit.t) * (hit.operand + 1.0) / OPERANDS; }
)";

/// Declares the layers that keep hits, and defines main() of a hit pass, which fills them.
inline constexpr const char* kHits = R"(
layout(location = 0) out vec4 hitSurface;   // the normal, and t
layout(location = 1) out vec2 hitIdentity;  // the operand, and the status

void main() {
  sdfTakeValues();
  TAKE_ROW
  Ray ray = rayThrough(floor(gl_FragCoord.xy) + within);
  START_RAY
  Hit hit = meet(ray);
  hitSurface = vec4(hit.normal, hit.t);
  hitIdentity = vec2(hit.operand, float(hit.status));
  gl_FragDepth = hit.status == MISS ? 1.0 : favoured(ray, hit) / maxDistance;
  STORE_COUNTS
}
)";

/// Defines primaryHit(), the Hit of this pixel as the layers keep it.
inline constexpr const char* kHitFromLayers = R"(
uniform sampler2D hitSurface, hitIdentity;

Hit primaryHit() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(hitSurface, pixel, 0);
  vec2 identity = texelFetch(hitIdentity, pixel, 0).xy;
  return Hit(int(identity.y), surface.w, surface.xyz, identity.x, 0);
}
)";

}  // namespace sdf::viewer::parts
