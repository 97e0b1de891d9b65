// The shaders' fixed parts, in the order in which they are put together. Each states what it needs of the
// ones before.
#pragma once

namespace sdf::viewer::parts {

/// The frame's uniforms, rayThrough(pixel) and hitDistance(ray, t).
extern const char* const kCamera;
/// Of sdfDistance: field(p), the radius of the ball around p that is free of the surface.
extern const char* const kField;
/// rest(p): the same of the scene without its planes, which rays meet by planesFrom(ray).
extern const char* const kRest;
extern const char* const kPlanes;
extern const char* const kNoPlanes;
/// clip(p, l, widening, t, reach): the part of the way to a light that can be dimmed.
extern const char* const kShadowSpan;
extern const char* const kNoShadowSpan;
/// leastOfPlanes(p, l, reach): least height over the planes by t, along the way to a light.
extern const char* const kPlanesLight;
extern const char* const kNoPlanesLight;
/// march(...): where a ray hits. METHOD_PLAIN chooses plain sphere tracing. Counts readings where COUNT says
/// so.
extern const char* const kMarch;
/// gradientAt(p): exact, or by differences for scenes whose gradient would be too long a program.
extern const char* const kGradient;
extern const char* const kGradientByTaps;
/// setFootprint(n, d, distance): what the pixel covers of a surface, for patterns (filter.h).
extern const char* const kFootprint;
/// normalAt(p, d), d being the way of the ray.
extern const char* const kNormal;
/// shadow(p, l, reach), one of four, and the uniforms of all.
extern const char* const kShadowSettings;
extern const char* const kHardShadow;
extern const char* const kSoftShadow;
extern const char* const kImprovedShadow;
extern const char* const kSignedShadow;
/// occlusion(p, n) by taps along the normal.
extern const char* const kOcclusionTaps;
extern const char* const kLightSettings;
/// Phong's lights over the attributes s[]: direct(p, n, d, s).
extern const char* const kLights;
/// favoured(ray, t, number): t less a hair that grows with the operand's number, since of two operands that
/// are hit at once the later shows.
extern const char* const kFavoured;
/// takenHit(...) and takenNormal(...): what the primary ray hits, from a texture. FIRST(taken, marched)
/// chooses.
extern const char* const kTakenHits;
/// radiance(ray, t): the whole stack along a ray and its reflections.
extern const char* const kRadiance;
/// colorOf(ray, t, budget) of the picture, and of each debug view over hit(...).
extern const char* const kColor;
extern const char* const kHit;
extern const char* const kNormalsView;
extern const char* const kStepsView;
extern const char* const kSliceView;
extern const char* const kGradientView;
extern const char* const kMaterialView;
extern const char* const kOcclusionView;
extern const char* const kShadowView;
/// encode(c): sRGB of linear colours.
extern const char* const kSrgb;
/// main() of the picture: one sample of each pixel, and the output's encoding.
extern const char* const kPicture;
/// main() that encodes the samples' sums.
extern const char* const kResolve;
/// main() of the cone pass.
extern const char* const kCones;
/// main() of a group's pass: what the primary rays hit of it.
extern const char* const kHits;

}  // namespace sdf::viewer::parts
