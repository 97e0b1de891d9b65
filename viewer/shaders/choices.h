// What can be chosen of a picture, and what the command line and the window's panels call it.
#pragma once
#include <iterator>

namespace sdf::viewer {

/// A Choice names one value of an enum; tables have them in the order of the enum.
template <class Enum>
struct Choice {
  Enum value;
  const char* word;       ///< on the command line
  const char* label;      ///< in the window
  const char* note = "";  ///< beside the word in --help
};

/// A View is what a pixel shows.
enum class View {
  Picture,    ///< the scene under its lights
  Normals,    ///< (n + 1) / 2
  Steps,      ///< readings of the primary ray as heat, from blue for none to red for the step budget; magenta
              ///< where it ran out
  Slice,      ///< the distance on a plane through what the camera looks at, with isolines
  Gradient,   ///< length of the distance's gradient at the hit: green 1, blue below, red above
  Material,   ///< diffuse colour, unlit
  Occlusion,  ///< ambient occlusion alone
  Shadow,     ///< share of the lights that arrives, the mean over those that cast shadows
  Mesh,       ///< a mesh of the scene, under the scene's lights
  Wire,       ///< the same with its triangles' edges
  Split,      ///< the picture, and beside it the mesh: shaders of this view draw the mesh's side
  Error,      ///< a mesh by its distance to the scene's surface
  Count
};
inline constexpr Choice<View> kViews[] = {{View::Picture, "picture", "Picture"},
                                          {View::Normals, "normals", "Normals"},
                                          {View::Steps, "steps", "Steps"},
                                          {View::Slice, "slice", "Distance slice"},
                                          {View::Gradient, "gradient", "Gradient"},
                                          {View::Material, "material", "Material"},
                                          {View::Occlusion, "occlusion", "Occlusion"},
                                          {View::Shadow, "shadow", "Shadow"},
                                          {View::Mesh, "mesh", "Mesh"},
                                          {View::Wire, "wire", "Mesh and edges", "its edges"},
                                          {View::Split, "split", "Picture | mesh", "beside the picture"},
                                          {View::Error, "error", "Mesh error", "distances to the surface"}};
static_assert(std::size(kViews) == static_cast<std::size_t>(View::Count));

/// Is a mesh shown, which a renderer is given (Renderer::showMesh), in the place of what rays meet?
constexpr bool showsMesh(View view) { return view >= View::Mesh && view < View::Count; }
/// Is light shown, and what it falls on?
constexpr bool isLit(View view) { return view == View::Picture || (showsMesh(view) && view != View::Error); }

/// A Method is how rays are marched.
enum class Method {
  AutoRelaxed,  ///< by steps as long as is safe to guess
  Plain         ///< by steps as long as is proven
};
inline constexpr Choice<Method> kMethods[] = {{Method::AutoRelaxed, "auto", "Auto-relaxed", "auto-relaxed"},
                                              {Method::Plain, "plain", "Plain"}};

/// A Start is where primary rays start.
enum class Start {
  Raster,  ///< where a hull of what they march is entered
  Cone,    ///< where cones of tiles say
  Plain    ///< at the eye
};
inline constexpr Choice<Start> kStarts[] = {{Start::Raster, "raster", "Hull", "where they enter a hull"},
                                            {Start::Cone, "cone", "Cones"},
                                            {Start::Plain, "plain", "Eye", "at the eye"}};

}  // namespace sdf::viewer
