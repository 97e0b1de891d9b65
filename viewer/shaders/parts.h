// The shaders' fixed parts, in the order in which they are put together. A part uses functions of those
// before it, uniforms that it or these declare, and macros, which are the words in capitals.
#pragma once
#include <span>

namespace sdf::viewer::parts {

/// Declares the frame's uniforms and a Ray, and defines rayThrough(pixel) and hitDistance(ray, t).
extern const char* const kCamera;
/// Declares a Hit: what a ray meets. Every way to find it fills this struct, and every use of it reads it.
extern const char* const kHit;
/// Defines field(p), the radius of the ball around p that is free of the whole's surface.
extern const char* const kField;
/// Defines rest(p), the same for the scene without its half spaces.
extern const char* const kRest;
/// Either defines planesFrom(ray), the t at which a ray enters the first of the half spaces.
extern const char* const kPlanes;
extern const char* const kNoPlanes;
/// Defines march(ray, status, readings), the t at which a ray hits the rest or a half space.
extern const char* const kMarch;
/// Either defines gradientAt(p): exactly, or by differences where the gradient is too long a program.
extern const char* const kGradient;
extern const char* const kGradientByTaps;
/// Defines normalAt(p, d), where d is the direction of the ray.
extern const char* const kNormal;
/// Defines meet(ray), the Hit of a ray that is marched.
extern const char* const kMeet;
/// Defines startRay(ray), which lets a primary ray start and end where the cone pass says.
extern const char* const kStarts;
/// Either declares the output of readings, of a hit pass or of the picture.
extern const char* const kHitCounts;
extern const char* const kPictureCounts;
/// Defines main() of the cone pass, beside farEnd(ray, spread, widening) from hit_shaders.cpp.
extern const char* const kCones;
/// Declares the layers that keep hits, and defines main() of a hit pass, which fills them.
extern const char* const kHits;
/// Defines primaryHit(), the Hit of this pixel as the layers keep it.
extern const char* const kHitFromLayers;
/// Defines setFootprint(n, d, distance), which says what a pixel covers of a surface (filter.h).
extern const char* const kFootprint;
/// Either defines clip(p, l, widening, t, reach), which leaves the part of the way to a light that can be
/// dimmed.
extern const char* const kShadowSpan;
extern const char* const kNoShadowSpan;
/// Either defines leastOfPlanes(p, l, reach), the least height over the half spaces by t along the way to a
/// light.
extern const char* const kPlanesLight;
extern const char* const kNoPlanesLight;
/// Declares the uniforms of all shadows, each of which defines shadow(p, l, reach), the share of a light that
/// arrives.
extern const char* const kShadowSettings;
extern const char* const kHardShadow;
extern const char* const kSoftShadow;
extern const char* const kImprovedShadow;
extern const char* const kSignedShadow;
/// Defines occlusion(p, n), by taps along the normal.
extern const char* const kOcclusionTaps;
/// Declares the uniform of occlusion by steps.
extern const char* const kOcclusionSteps;
/// Declares the lights.
extern const char* const kLightSettings;
/// Defines direct(p, n, d, s), Phong's light from the surface's attributes s[].
extern const char* const kLights;
/// Each defines colorOf(ray, spent), what a pixel shows, and whether a ray ran out of steps: the whole stack
/// along a ray and its reflections, the background alone, the slice, or what shown(ray, hit) says of the
/// primary hit.
extern const char* const kRadiance;
extern const char* const kBackground;
extern const char* const kSliceView;
extern const char* const kHitColor;
/// Each defines shown(ray, hit), the colour of a debug view.
extern const char* const kHitsView;
extern const char* const kNormalsView;
extern const char* const kStepsView;
extern const char* const kGradientView;
extern const char* const kMaterialView;
extern const char* const kOcclusionView;
extern const char* const kShadowView;
/// Declares the colour of debug views where there is nothing.
extern const char* const kNothing;
/// Defines encode(c), the sRGB of linear colours.
extern const char* const kSrgb;
/// Defines main() of the picture: one sample of each pixel, encoded if it is the only one.
extern const char* const kPicture;
/// Defines main() of the pass that encodes the samples' sums.
extern const char* const kResolve;

/// Returns the texts of all parts.
std::span<const char* const> all();

}  // namespace sdf::viewer::parts
