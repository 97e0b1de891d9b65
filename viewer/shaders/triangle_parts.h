// The shaders' parts that draw triangles into the layers of hits; see ray_parts.h.
#pragma once

namespace sdf::viewer::parts {

/// The vertex shader. Its uniforms place the triangles before the eye, in double on the CPU, so that they are
/// as sharp far from the origin.
inline constexpr const char* kTrianglesVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
layout(location = 3) in vec2 coordinates;
layout(location = 4) in vec3 answer;
layout(location = 5) in float distance;
uniform vec4 toEye[3];    // rows: along the picture's right and up, and forward
uniform vec4 toNormal[3]; // rows: of a normal in the scene
uniform vec4 lens;        // pictures' heights by their distance, along x also by their width; the sample's shift
uniform float nearest;    // distance along `forward` from which on triangles are seen
out vec3 seen, facing, tint, toAmbient, corner;
out float off;
out vec2 textureAt;

void main() {
  vec4 p = vec4(position, 1.0);
  seen = vec3(dot(toEye[0], p), dot(toEye[1], p), dot(toEye[2], p));
  facing = vec3(dot(toNormal[0].xyz, normal), dot(toNormal[1].xyz, normal), dot(toNormal[2].xyz, normal));
  tint = color;
  textureAt = coordinates;
  toAmbient = answer;
  off = distance;
  corner = vec3(equal(ivec3(gl_VertexID % 3), ivec3(0, 1, 2)));  // where no triangles share vertices
  gl_Position = vec4(lens.xy * seen.xy + lens.zw * seen.z, seen.z - 2.0 * nearest, seen.z);
}
)";

/// Declares the layer of what is drawn of a mesh that is shown as a whole, and what it is filled from.
inline constexpr const char* kMarks = R"(
layout(location = MARK) out vec4 hitMark;      // how much of an edge it is, and the distance
in vec3 toAmbient, corner;
in float off;
uniform float edges;  // how wide they are in pixels

// Where triangles are no larger than a few pixels the edges, which would be all, fade to a share of what they cover.
float edgeHere() {
  if (edges == 0.0) return 0.0;
  vec3 slope = sqrt(pow(dFdx(corner), vec3(2.0)) + pow(dFdy(corner), vec3(2.0)));  // 1 / heights in pixels
  vec3 away = corner / slope;
  float near = min(away.x, min(away.y, away.z)), height = 1.0 / max(slope.x, max(slope.y, slope.z));
  return mix(0.15, clamp(0.5 * edges + 0.5 - near, 0.0, 1.0), smoothstep(2.0 * edges, 8.0 * edges, height));
}

void storeMarks(inout vec4 glow) {
  glow.rgb *= toAmbient;
  hitMark = vec4(edgeHere(), off, 0.0, 0.0);
}
)";

/// Declares the layers of hits and of how drawn triangles look, and defines main() of the pass that fills
/// them. It uses favoured() of kHits' part.
inline constexpr const char* kTriangles = R"(
layout(location = 0) out vec4 hitSurface;
layout(location = 1) out vec2 hitIdentity;
layout(location = LOOK) out vec4 hitLook;      // linear base colour, and roughness
layout(location = GLOW) out vec4 hitGlow;      // emission, and how much of a metal it is
in vec3 seen, facing, tint;
in vec2 textureAt;
uniform sampler2D colorTexture, emissionTexture;
uniform vec4 look, glow;
uniform vec2 identity;  // operand and status

void main() {
  Ray ray = rayThrough(floor(gl_FragCoord.xy) + within);
  vec3 flat_ = cross(dFdx(seen), dFdy(seen));
  vec3 n = facing;
  if (n == vec3(0.0)) {
    n = flat_.x * right + flat_.y * up + flat_.z * normalize(forward);
    n *= -sign(dot(n, ray.direction));
  } else if (!gl_FrontFacing) {
    n = -n;
  }
  Hit hit = Hit(int(identity.y), length(seen) - ray.before, normalize(n), identity.x, 0);
  hitSurface = vec4(hit.normal, hit.t);
  hitIdentity = identity;
  hitLook = vec4(look.rgb * tint * texture(colorTexture, textureAt).rgb, look.a);
  hitGlow = vec4(glow.rgb * texture(emissionTexture, textureAt).rgb, glow.a);
  STORE_MARKS
  gl_FragDepth = favoured(ray, hit) / maxDistance;
}
)";

/// Defines main() of the pass that draws where rays enter and leave a hull (march/hull.h), in the terms of
/// kRayStarts' texels, of which the least are kept.
inline constexpr const char* kHullStarts = R"(
layout(location = 0) out vec4 start;
in vec3 seen, facing, tint;
in vec2 textureAt;

void main() {
  float far = length(seen), hair = 1e-5 * far, t = far - rayThrough(floor(gl_FragCoord.xy) + within).before;
  start = gl_FrontFacing ? vec4(t - hair, 0.0, -t - hair, 1e30) : vec4(1e30, 0.0, -t - hair, t - hair);
}
)";

/// Defines takeMeshLook(hit, s), which does that for triangles of a mesh that is shown as a whole: those of
/// the scene's own have its Phong numbers, the colours by vertex, the others by material.
inline constexpr const char* kTakeMeshLook = R"(
uniform sampler2D hitMark, meshMaterials;

void takeMeshLook(Hit hit, inout float s[ATTRIBUTES]) {
  takeLook(hit, s);
  if (hit.status == MESHED) {
    vec4 look = texelFetch(hitLook, ivec2(gl_FragCoord.xy), 0), glow = texelFetch(hitGlow, ivec2(gl_FragCoord.xy), 0);
    int row = int(look.a + 0.5);
    vec4 light = texelFetch(meshMaterials, ivec2(0, row), 0), mirror = texelFetch(meshMaterials, ivec2(1, row), 0);
    vec4 emission = texelFetch(meshMaterials, ivec2(2, row), 0);
    s[RED] = look.r, s[GREEN] = look.g, s[BLUE] = look.b;
    s[AMBIENT_RED] = glow.r, s[AMBIENT_GREEN] = glow.g, s[AMBIENT_BLUE] = glow.b;
    s[SPECULAR_RED] = light.r, s[SPECULAR_GREEN] = light.g, s[SPECULAR_BLUE] = light.b;
    s[SHININESS] = light.a;
    s[REFLECTIVITY] = mirror.x, s[FRESNEL_POWER] = mirror.y, s[FRESNEL_BIAS] = mirror.z;
    s[EMISSION_RED] = emission.r, s[EMISSION_GREEN] = emission.g, s[EMISSION_BLUE] = emission.b;
  }
  s[REFLECTIVITY] *= 1.0 - texelFetch(hitMark, ivec2(gl_FragCoord.xy), 0).x;
}
)";

/// Defines edged(c), a linear colour with the edges of triangles over it: dark on bright ones, bright on dark
/// ones.
inline constexpr const char* kEdged = R"(
vec3 edged(vec3 c) {
  float bright = dot(c, vec3(0.2126, 0.7152, 0.0722));
  vec3 line = mix(2.0 * c + 0.35, 0.08 * c, smoothstep(0.03, 0.12, bright));
  return mix(c, line, texelFetch(hitMark, ivec2(gl_FragCoord.xy), 0).x);
}
)";

/// Defines takeLook(hit, s), which gives a surface's attributes the look of triangles that were drawn: as
/// meanMaterial() does (shape/solids/triangle_solid.h).
inline constexpr const char* kTakeLook = R"(
uniform sampler2D hitLook, hitGlow;

void takeLook(Hit hit, inout float s[ATTRIBUTES]) {
  if (hit.status != DRAWN) return;
  vec4 look = texelFetch(hitLook, ivec2(gl_FragCoord.xy), 0), glow = texelFetch(hitGlow, ivec2(gl_FragCoord.xy), 0);
  float rough = max(look.a, 0.05), shininess = 0.5 * (1.0 / (rough * rough * rough * rough) - 1.0);
  float mirror = glow.a * (1.0 - look.a);
  vec3 color = (1.0 - mirror) * look.rgb, straight = mix(vec3(0.04), look.rgb, glow.a);
  float most = max(straight.r, max(straight.g, straight.b));
  vec3 specular = straight * min((4.0 * shininess + 2.0) / 8.0, 1.0 / max(most, 1e-9));
  s[RED] = color.r, s[GREEN] = color.g, s[BLUE] = color.b;
  s[AMBIENT_RED] = color.r, s[AMBIENT_GREEN] = color.g, s[AMBIENT_BLUE] = color.b;
  s[SPECULAR_RED] = specular.r, s[SPECULAR_GREEN] = specular.g, s[SPECULAR_BLUE] = specular.b;
  s[SHININESS] = shininess;
  s[REFLECTIVITY] = mirror;
  s[FRESNEL_POWER] = 5.0;
  s[FRESNEL_BIAS] = most;
  s[EMISSION_RED] = glow.r, s[EMISSION_GREEN] = glow.g, s[EMISSION_BLUE] = glow.b;
}
)";

}  // namespace sdf::viewer::parts
