-- A small creature: painted limbs melt into its body, so that colours run into each other as the shapes do.
camera{from = {1.7, 1.6, 4.3}, to = {0.05, 0.86, 0}, fov = 34}
directional_light{direction = {1.4, 2, 1.6}, color = {1, 0.92, 0.8}, intensity = 0.85}
directional_light{direction = {-1.5, 0.6, -1}, color = {0.6, 0.5, 1}, intensity = 0.35, shadow = false}
ambient{0.28, 0.29, 0.33}
background(vertical_gradient("#d9a98a", "#fbeedd"))
shadows{kind = "soft", sharpness = 6}
ambient_occlusion{spacing = 0.08, strength = 0.3}

local function soft(colour) return material{color = colour, specular = 0.25, shininess = 30} end
local belly = ellipsoid_bound(0.62, 0.6, 0.55):translate(0, 0.66, 0):paint(soft("#2fa58f"))
local tummy = ellipsoid_bound(0.4, 0.42, 0.2):translate(0, 0.56, 0.43):paint(soft("#f3e2b0"))
local head = sphere(0.46):translate(0, 1.32, 0.08):paint(soft("#3fb6c9"))
local snout = ellipsoid_bound(0.24, 0.16, 0.2):translate(0, 1.2, 0.48):paint(soft("#f2a07b"))
local ear = capsule({0.22, 1.6, 0}, {0.42, 1.98, -0.1}, 0.09):paint(soft("#8f5bd0")):mirror("x")
local arm = capsule({0.5, 0.85, 0.1}, {0.82, 0.6, 0.42}, 0.12):paint(soft("#e8c23d")):mirror("x")
local foot = ellipsoid_bound(0.22, 0.13, 0.32):translate(0.3, 0.12, 0.22):paint(soft("#e06a4a")):mirror("x")
local stump = capsule({0, 0.35, -0.4}, {0.35, 0.22, -0.85}, 0.16)
local tip = capsule({0.35, 0.22, -0.85}, {0.8, 0.5, -0.95}, 0.09)
local tail = union({stump, tip}, {k = 0.15}):paint(soft("#8f5bd0"))
part("body", union({belly, tummy, head, snout, ear, arm, foot, tail}, {k = 0.16}))

local iris = function(x, y, z)
  local d = length(x, y) / 0.13
  return select(less(d, 0.42), "#0c0c10", select(less(d, 0.72), mix("#3a2a7a", "#8a66e0", d), "#ffffff"))
end
local eye = sphere(0.13):paint{name = "iris", color = iris, specular = 0.9, shininess = 200}:rotate(-4, 8, 0)
part("eyes", eye:translate(0.19, 1.47, 0.44):mirror("x"))
local spots = material{name = "ground", specular = 0.05, color = function(x, y, z)
  return mix("#7fae5a", "#a4c76d", smoothstep(-0.2, 0.4, noise(5 * x, 0, 5 * z, {octaves = 3})))
end}
part("ground", cylinder(1.9, 0.08):round(0.04):translate(0, -0.12, 0):paint(spots))
