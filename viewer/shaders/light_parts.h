// The shaders' fixed parts that shade what rays meet; see ray_parts.h.
#pragma once

namespace sdf::viewer::parts {

/// Defines setFootprint(n, d, distance), which says what a pixel covers of a surface (filter.h).
inline constexpr const char* kFootprint = R"(
uniform float footprint;  // a sample's share of the picture, as wide as this at distance 1; 0: sharp patterns

void setFootprint(vec3 n, vec3 d, float distance) {
  float facing = dot(n, d);
  pixelWay = d / (facing < 0.0 ? min(facing, -1e-4) : max(facing, 1e-4));
  pixelSize = footprint * distance;
}
)";

/// Defines bayer(), the pixel's number in Bayer's pattern of 8 by 8.
inline constexpr const char* kBayer = R"(
uint bayer() {
  uint y = uint(gl_FragCoord.y), x = uint(gl_FragCoord.x) ^ y;
  return (x & 1u) << 5u | (y & 1u) << 4u | (x & 2u) << 2u | (y & 2u) << 1u | (x & 4u) >> 1u | (y & 4u) >> 2u;
}
)";

/// Defines inPixel(place), a sample's place in the unit square as this pixel has it: all samples' are shifted
/// alike (Cranley, Patterson 1976), by Bayer's pattern, so that pictures are the same each time; and
/// around(axis, cosine, sine, turn), a direction at that angle to an axis, turned by a share of the circle.
inline constexpr const char* kChosen = R"(
vec2 inPixel(vec2 place) {
  uint shift = bayer();
  return fract(place + vec2(float(shift) + 0.5, float(shift * 29u & 63u) + 0.5) / 64.0);
}

vec3 around(vec3 axis, float cosine, float sine, float turn) {
  vec3 across = normalize(cross(axis, abs(axis.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  turn *= 6.2831853;
  return cosine * axis + sine * (cos(turn) * across + sin(turn) * cross(axis, across));
}
)";

/// Either defines clip(p, l, widening, t, reach), which leaves the part of the way to a light that can be
/// dimmed.
/// Only what is nearer to the ray than t / k dims the light: within a ball around the rest's bounds that
/// grows with t, |p + t l - c| < R + t / k, and within these bounds grown by the most of that.
inline constexpr const char* kShadowSpan = R"(
void clip(vec3 p, vec3 l, float widening, inout float t, inout float reach) {
  vec3 away = p - 0.5 * (BOX_MIN + BOX_MAX);
  float radius = 0.5 * length(BOX_MAX - BOX_MIN);
  float a = 1.0 - widening * widening, b = dot(away, l) - radius * widening;
  float root = b * b - a * (dot(away, away) - radius * radius), deep = sqrt(max(root, 0.0));
  reach = root > 0.0 ? min(reach, (deep - b) / a) : 0.0;
  float grown = max(reach, 0.0) * widening;
  vec3 low = (BOX_MIN - grown - p) / l, high = (BOX_MAX + grown - p) / l;
  vec3 enter = min(low, high), leave = max(low, high);
  reach = min(reach, min(leave.x, min(leave.y, leave.z)));
  t = max(max(t, (-deep - b) / a), max(enter.x, max(enter.y, enter.z)));
}
)";

inline constexpr const char* kNoShadowSpan = R"(
void clip(vec3 p, vec3 l, float widening, inout float t, inout float reach) {}
)";

/// Either defines leastOfPlanes(p, l, reach), the least height over the half spaces by t along the way to a
/// light.
/// height / t falls with t, so it is least at the end; below 0 the light is behind the plane.
inline constexpr const char* kPlanesLight = R"(
float leastOfPlanes(vec3 p, vec3 l, float reach) {
  float planes[PLANES], least = 1.0;
  sdfPlanes(p, l, planes);
  for (int i = 0; i < PLANES; i += 2) least = min(least, max(planes[i], 0.0) / reach + planes[i + 1]);
  return least;
}
)";

inline constexpr const char* kNoPlanesLight = R"(
float leastOfPlanes(vec3 p, vec3 l, float reach) { return 1.0; }
)";

/// Either defines leastOfBalls(p, l, start, reach), the least distance to a ball by t between these ends.
/// A cone from p around l, t sin a wide, touches the ball where a is the angle between l and the ball's
/// middle less the ball's own, and as far off as the ball's tangents from p touch it, divided by cos a.
inline constexpr const char* kBallsLight = R"(
float leastOfBalls(vec3 p, vec3 l, float start, float reach) {
  float balls[BALLS], least = 1.0;
  sdfBalls(vec3(0.0), vec3(0.0), balls);
  for (int i = 0; i < BALLS; i += 4) {
    vec3 way = vec3(balls[i], balls[i + 1], balls[i + 2]) - p;
    float middle = dot(way, l), square = max(balls[i + 3], 0.0), radius = sqrt(square);
    vec3 by = way - middle * l;
    float aside = dot(by, by), far = dot(way, way), tangent = sqrt(max(far - square, 0.0));
    float across = middle * tangent + radius * sqrt(aside);  // cos a, times the square of the way
    float t = across > 0.0 ? clamp(tangent * far / across, start, reach) : reach;
    if (balls[i + 3] > 0.0) least = min(least, (sqrt(aside + (t - middle) * (t - middle)) - radius) / t);
  }
  return max(least, 0.0);
}

bool ballsHide(vec3 p, vec3 l, float start, float reach) { return ballsFrom(p + start * l, l, 1e30) < reach - start; }
)";

inline constexpr const char* kNoBallsLight = R"(
float leastOfBalls(vec3 p, vec3 l, float start, float reach) { return 1.0; }

bool ballsHide(vec3 p, vec3 l, float start, float reach) { return false; }
)";

/// Declares the uniforms of all shadows, each of which defines shadow(p, l, reach), the share of a light that
/// arrives. Distances that are read LOOSE say little of how far the surface is where slopes are far from 1:
/// seen(p, g), what shadows go by, divides them by the slope, and lets no ray creep.
inline constexpr const char* kShadowSettings = R"(
uniform float shadowStart, shadowReach, shadowHit, sharpness;
uniform int shadowSteps;

bool shadowSpent = false;  // a ray of the pixel's shadows ran out of steps

// How far one may go and how far the surface is, from a reading g near it: where the value along its slope is 0, by a
// step of Newton's and one of Schroeder's (1870), who takes the order of a root from how the value bends. A reading of
// more than what is marched, such as a half space, is as far as it says where that is less.
vec2 seen(vec3 p, vec2 g) {
  if (!LOOSE || g.y <= 0.0 || READS_MORE && g.y < READ_BY_SHADOWS(p, 2.0 * g.y).y) return g;
  float h = 1e-4 * max(unit, max(abs(p.x), max(abs(p.y), abs(p.z))));
  vec3 slope = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 corner = vec3(float(((i + 3) >> 1) & 1), float((i >> 1) & 1), float(i & 1)) * 2.0 - 1.0;
    slope += 0.25 / h * READ_BY_SHADOWS(p + h * corner, 2.0 * g.y).y * corner;
  }
  float steep = max(length(slope), 1e-30), first = g.y / steep;
  vec3 way = 0.5 * first / steep * slope, there = p - 2.0 * way;
  float before = READ_BY_SHADOWS(there + way, 2.0 * g.y).y, value = READ_BY_SHADOWS(there, 2.0 * g.y).y;
  float after = READ_BY_SHADOWS(there - way, 2.0 * g.y).y, fall = before - after;
  float bend = 4.0 * value * (before + after - 2.0 * value) / max(fall * fall, 1e-30);
  float second = fall > 0.0 ? first * value / (fall * (1.0 - clamp(bend, -1.0, 0.75))) : 0.0;
  float far = max(g.x, first + clamp(second, -0.5 * first, 3.0 * first));
  return vec2(max(g.x, min(0.5 * far, shadowHit)), far);
}

// The light of a ray that came so far. What lies behind the last step of one that ran out is not known: it is dark.
float ended(float t, float reach, float light) {
  if (t >= reach) return light;
  shadowSpent = true;
  return 0.0;
}
)";

/// Defines visible(p, l, reach), 1 where a light can be seen and 0 elsewhere.
inline constexpr const char* kVisible = R"(
float visible(vec3 p, vec3 l, float reach) {
  float t = shadowStart;
  if (leastOfPlanes(p, l, reach) <= 0.0 || ballsHide(p, l, t, reach)) return 0.0;
  clip(p, l, 0.0, t, reach);
  for (int i = 0; i < shadowSteps && t < reach; ++i) {
    vec2 g = rest(p + t * l, 0.0);
    COUNT_SHADOW
    if (max(g.x, g.y) <= shadowHit) g = seen(p + t * l, g);
    if (max(g.x, g.y) <= shadowHit) return 0.0;
    t += g.x;
  }
  return ended(t, reach, 1.0);
}
)";

inline constexpr const char* kHardShadow = R"(
float shadow(vec3 p, vec3 l, float reach) { return visible(p, l, reach); }
)";

/// Between readings by sdf/march/shadow.h's parabola: far, least, stepBefore and riseBefore are the t of the
/// reading before, its f / t, the step to it and how f * f rose along that; before is the f / t of the one
/// before that. What is so far that it leaves all light needs no exact reading: the parabola lessens an f / t
/// to no less than sqrt(0.75) of it.
inline constexpr const char* kSoftShadow = R"(
float shadow(vec3 p, vec3 l, float reach) {
  float t = shadowStart, least = min(leastOfPlanes(p, l, reach), leastOfBalls(p, l, t, reach));
  float light = clamp(sharpness * least, 0.0, 1.0);
  if (light == 0.0) return 0.0;
  clip(p, l, min(1.0 / sharpness, 0.9), t, reach);
  least = 0.0;
  float far = 0.0, stepBefore = 0.0, riseBefore = 0.0, before = 0.0;
  for (int i = 0; i < shadowSteps && t < reach; ++i) {
    vec2 g = rest(p + t * l, 1.2 * t / sharpness);
    COUNT_SHADOW
    if (min(g.x, g.y) < t / sharpness) g = seen(p + t * l, g);
    if (max(g.x, g.y) <= shadowHit) return 0.0;
    float ratio = g.y / t, step = t - far, rise = (g.y * g.y - least * least * far * far) / step;
    light = min(light, sharpness * ratio);
    if (i > 1 && least < 0.998 * min(before, ratio)) {  // the least f / t is around the reading before
      float bend = (rise - riseBefore) / (stepBefore + step), slope = riseBefore + bend * stepBefore;
      float square = least * least * far * far, steep = 2.0 * bend * far - slope;
      float x = clamp((2.0 * square - slope * far) / (steep == 0.0 ? 1.0 : steep), -stepBefore, step);
      float there = (square + (slope + bend * x) * x) / ((far + x) * (far + x));
      light = min(light, sharpness * sqrt(max(there, 0.75 * least * least)));
    }
    before = least;
    least = ratio;
    stepBefore = step;
    riseBefore = rise;
    far = t;
    t += (sharpness * ratio < 1.0 ? 0.6 : 1.0) * g.x;
  }
  return ended(t, reach, light);
}
)";

inline constexpr const char* kImprovedShadow = R"(
float shadow(vec3 p, vec3 l, float reach) {
  float t = shadowStart, light = 1.0, step = 0.0, before = 0.0;
  for (int i = 0; i < shadowSteps && (i == 0 || t < reach); ++i) {
    vec2 both = field(p + t * l);
    COUNT_SHADOW
    if (min(both.x, both.y) < t / sharpness) both = seen(p + t * l, both);
    float f = both.y;
    if (max(both.x, f) <= shadowHit) return 0.0;
    float y = step > 0.0 && !LOOSE ? (step * step + f * f - before * before) / (2.0 * step) : 0.0;
    if (y >= step) y = 0.0;
    y = max(y, 0.0);
    light = min(light, sharpness * sqrt(max(0.0, f * f - y * y)) / (t - y));
    step = both.x;
    before = f;
    t += step;
  }
  return ended(t, reach, light);
}
)";

inline constexpr const char* kSignedShadow = R"(
float shadow(vec3 p, vec3 l, float reach) {
  float t = shadowStart, x = 1.0;
  for (int i = 0; i < shadowSteps && (i == 0 || t < reach); ++i) {
    vec2 g = field(p + t * l);
    COUNT_SHADOW
    if (min(g.x, g.y) < t / sharpness) g = seen(p + t * l, g);
    x = min(x, sharpness * g.y / t);
    if (x <= -1.0) return 0.0;
    t += max(abs(g.x), shadowHit);
  }
  return ended(t, reach, 0.25 * (1.0 + x) * (1.0 + x) * (2.0 - x));
}
)";

/// Either defines arriving(i, p, l, far), the share of light i that arrives at p, `far` from its middle in
/// the direction l.
inline constexpr const char* kArriving = R"(
float arriving(int i, vec3 p, vec3 l, float far) {
  return shadow(p, l, lightVector[i].w > 0.0 ? min(shadowReach, far) : shadowReach);
}
)";

/// Of a light that has a size all or nothing, by whether one of its points is seen: a sample's is one of
/// those that look alike large (Shirley, Wang, Zimmerman, "Monte Carlo techniques for direct lighting
/// calculations", 1996). A ray ends where it meets the ball.
inline constexpr const char* kArrivingSized = R"(
uniform float lightSize[LIGHTS];  // its radius; if it is far away the sine of half the angle that it is seen under
uniform vec2 lightPlace;          // the sample's, in the unit square

float arriving(int i, vec3 p, vec3 l, float far) {
  bool isBall = lightVector[i].w > 0.0;
  float size = lightSize[i], reach = isBall ? min(shadowReach, far) : shadowReach;
  if (size == 0.0) return shadow(p, l, reach);
  float rim = isBall ? min(size / far, 1.0) : size;  // the sine of its angle
  vec2 u = inPixel(lightPlace);
  float low = u.x * rim * rim / (1.0 + sqrt(1.0 - rim * rim));  // 1 - the cosine of the ray's
  float cosine = 1.0 - low, sine = sqrt(low * (2.0 - low));
  float enters = far * cosine - sqrt(max(size * size - far * far * sine * sine, 0.0));
  if (isBall) reach = min(shadowReach, max(enters, shadowStart));
  return visible(p, around(l, cosine, sine, u.y), reach);
}
)";

/// Defines occlusion(p, n), by taps along the normal, the farthest first: where nothing is nearer to it than
/// p, and slopes are at most 1, nothing is to those below.
inline constexpr const char* kOcclusionTaps = R"(
uniform float tapSpacing, tapStrength;

float occlusion(vec3 p, vec3 n) {
  float closed = 0.0;
  for (int i = TAPS; i > 0; --i) {
    float h = tapSpacing * float(i), f = DISTANCE_UP_TO(p + h * n, h);
    COUNT_OCCLUSION
    if (IS_FREE) break;
    closed += (h - OVER_SURFACE) / h;
  }
  return clamp(1.0 - tapStrength * closed, 0.0, 1.0);
}
)";

/// Declares the uniform of occlusion by steps.
inline constexpr const char* kOcclusionSteps = R"(
uniform float tapStrength;
)";

/// Defines lightAround(n), the background's light; see sdf/scene/background_light.h.
inline constexpr const char* kLightAround = R"(
uniform vec4 backgroundLight[9];

vec3 lightAround(vec3 n) {
  vec4 light = backgroundLight[0] + n.x * backgroundLight[1] + n.y * backgroundLight[2] + n.z * backgroundLight[3] +
               n.x * n.y * backgroundLight[4] + n.y * n.z * backgroundLight[5] + n.z * n.x * backgroundLight[6] +
               (3.0 * n.z * n.z - 1.0) * backgroundLight[7] + (n.x * n.x - n.y * n.y) * backgroundLight[8];
  return max(light.rgb, 0.0);
}
)";

/// Declares the lights.
inline constexpr const char* kLightSettings = R"(
uniform vec4 lightVector[LIGHTS];  // xyz: towards the light, of length 1, if w is 0; its position if w is 1
uniform vec4 lightColor[LIGHTS];   // times its intensity; w: 1 if it casts shadows
)";

/// Defines direct(p, n, d, s), Phong's light from the surface's attributes s[].
inline constexpr const char* kLights = R"(
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

/// Defines glossy(d, n, exponent), a mirrored direction within the lobe of Phong's highlight: its cosine to
/// the mirror image of d is u^(1 / (exponent + 1)) (Lafortune, Willems 1994).
inline constexpr const char* kGlossy = R"(
uniform vec2 lobe;  // the sample's place in the unit square

vec3 glossy(vec3 d, vec3 n, float exponent) {
  vec2 u = inPixel(lobe);
  float cosine = pow(u.x, 1.0 / (exponent + 1.0));
  vec3 way = around(reflect(d, n), cosine, sqrt(1.0 - cosine * cosine), u.y);
  return way - min(2.0 * dot(way, n), 0.0) * n;  // none goes into the surface
}
)";

/// Defines colorOf(ray, spent), what a pixel shows, and whether a ray ran out of steps: the whole stack along
/// a ray and its reflections.
inline constexpr const char* kRadiance = R"(
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
      LEAVE_BACKGROUND
      total += through * sdfBackground(ray.direction, vec3(0.0));
      break;
    }
    if (hit.status == BUDGET) spent = true;
    float t = hit.t;
    vec3 p = ray.origin + t * ray.direction, d = ray.direction, n = hit.normal;
    LIFT
    float s[ATTRIBUTES];
    FOOTPRINT
    TAKE_OPERAND
    sdfSurface(p, n, s);
    TAKE_LOOK
    vec3 local = AMBIENT * vec3(s[AMBIENT_RED], s[AMBIENT_GREEN], s[AMBIENT_BLUE]) * OCCLUSION;
    local += DIRECT + vec3(s[EMISSION_RED], s[EMISSION_GREEN], s[EMISSION_BLUE]);
    local *= STEP_OCCLUSION;
    local = EDGED(local);
    float clear = exp(-fogDensity * (bounce == 0 ? ray.before + t : t));
    vec3 mirror = vec3(0.0);
#if BOUNCES > 0
    if (bounce < BOUNCES && s[REFLECTIVITY] > 0.0) {
      float edge = 1.0 - max(dot(-d, n), 0.0);
      vec3 tint = vec3(s[SPECULAR_RED], s[SPECULAR_GREEN], s[SPECULAR_BLUE]);
      float peak = max(tint.r, max(tint.g, tint.b));
      tint = peak > 0.0 ? tint / peak : vec3(1.0);
      vec3 rim = s[FRESNEL_POWER] == 0.0 ? tint : vec3(pow(edge, s[FRESNEL_POWER]));
      mirror = min(s[REFLECTIVITY] * (s[FRESNEL_BIAS] * tint + rim), 1.0);
    }
#endif
    total += through * mix(fogColor, (1.0 - mirror) * local, clear);
    through *= clear * mirror;
    if (max(through.r, max(through.g, through.b)) < 1.0 / 1024.0) break;
    float off = 2.0 * hitDistance(ray, t);
    ray = Ray(p + off * n, MIRRORED, ray.before + t, 0.0, 1e30, maxDistance);
  }
  return total;
}
)";

/// The same of the background alone.
inline constexpr const char* kBackground = R"(
vec3 colorOf(Ray ray, out bool spent) {
  spent = false;
  return sdfBackground(ray.direction, vec3(0.0));
}
)";

/// Defines encode(c), the sRGB of linear colours.
inline constexpr const char* kSrgb = R"(
vec3 encode(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
)";

/// Defines filmic(c), linear colours by Tone::Filmic.
inline constexpr const char* kFilmic = R"(
vec3 filmic(vec3 c) {
  c = max(c, 0.0);
  return min(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 1.0);
}
)";

/// Defines dithered(c): a colour moved by less than half a step of what the target holds, so that slow
/// changes do not show as bands. How far follows from the pixel, by Bayer's pattern of 8 by 8, which files
/// still pack well; a colour that is one of the target's stays.
inline constexpr const char* kDither = R"(
uniform float grain;  // the step; 0: floats, which need none

vec3 dithered(vec3 c) {
  return c + grain * ((float(bayer()) + 0.5) / 64.0 - 0.5);
}
)";

/// Defines throughLens(ray), which lets a primary ray start at a point of the lens; it meets the plane in
/// focus where it did.
inline constexpr const char* kLens = R"(
uniform float aperture, focus;  // radius, and how far ahead is seen sharply
uniform vec2 lensPlace;         // the sample's, in the unit square

void throughLens(inout Ray ray) {
  vec2 u = inPixel(lensPlace);
  vec3 off = aperture * sqrt(u.x) * (cos(6.2831853 * u.y) * right + sin(6.2831853 * u.y) * up);
  float focal = length(forward), share = focal / focus;
  vec3 way = ray.direction * (focal * focal / dot(ray.direction, forward)) - share * off;
  float far = length(way);
  ray = Ray(ray.origin + (1.0 - ahead * share) * off, way / far, ahead * far, 0.0, 1e30, maxDistance - ahead * far);
}
)";

/// Defines main() of the picture: one sample of each pixel, encoded if it is the only one.
inline constexpr const char* kPicture = R"(
layout(location = 0) out vec4 color;  // alpha is 0 where a ray ran out of steps, 1/2 where only a shadow's did

void main() {
  sdfTakeValues();
  Ray ray = rayThrough(floor(gl_FragCoord.xy) + within);
  START_RAY
  bool spent;
  vec3 c = colorOf(ray, spent);
  bool shaded = !spent && SHADOW_SPENT;
  // Among the samples of a sum, each whose shadow ran out adds 2 to the share of those that did not run out at all.
  if (weight < 1.0)
    color = vec4(weight * c, spent ? 0.0 : shaded ? weight + 2.0 : weight);
  else
    color = vec4(ENCODE(c), spent ? 0.0 : shaded ? 0.5 : 1.0);
  STORE_COUNTS
}
)";

/// Defines main() of the pass that encodes the samples' sums.
inline constexpr const char* kResolve = R"(
uniform sampler2D sums;
uniform float weight;
uniform float drawn;  // the share of all samples that is in the sums
layout(location = 0) out vec4 color;

void main() {
  vec4 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
  float shaded = floor(0.5 * (sum.a + 0.5 * weight)), unspent = sum.a - 2.0 * shaded;
  color = vec4(ENCODE(sum.rgb / drawn), unspent < drawn - 0.5 * weight ? 0.0 : shaded > 0.0 ? 0.5 : 1.0);
}
)";

}  // namespace sdf::viewer::parts
