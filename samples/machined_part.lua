-- A bearing block: plain booleans, as a machinist would cut it. One unit is a centimetre here.

local bore = param("bore", 1.1, {min = 0.4, max = 1.5})

local foot = round_box(2.7, 0.4, 1.2, 0.1)
local housing = cylinder(1.7, 1.2):rotate(90, 0, 0):translate(0, 1.5, 0)
local block = union { foot, housing, k = 0.2 } & box(3, 3, 1.2):translate(0, 2.6, 0)
local hole = cylinder(bore, 3):rotate(90, 0, 0):translate(0, 1.5, 0)
local bolts = cylinder(0.28, 2):translate(2.2, 0, 0.6) | cylinder(0.28, 2):translate(2.2, 0, -0.6)
local oil = cylinder(0.15, 2):translate(0, 3.2, 0)

local steel = material {
  name = "steel", color = {0.1, 0.1, 0.105}, specular = {0.86, 0.88, 0.92}, shininess = 90,
  reflectivity = 1, fresnel_power = 5, fresnel_bias = 0.6,
}
local brass = material {
  name = "brass", color = {0.1, 0.07, 0.02}, specular = {1, 0.74, 0.33}, shininess = 300,
  reflectivity = 1, fresnel_power = 5, fresnel_bias = 0.8,
}
part("block", (block - hole - bolts:mirror("x") - oil):paint(steel))

local bush = cylinder(bore, 1.3) - cylinder(bore - 0.2, 2)
part("bush", bush:rotate(90, 0, 0):translate(0, 1.5, 0):paint(brass))

camera { from = {4.5, 4, 7}, to = {0, 1.2, 0}, fov = 40 }
directional_light { direction = {1, 2, 1.5} }
directional_light { direction = {-2, 1, 1}, intensity = 0.3, shadow = false }
ambient(0.2)
shadows { kind = "soft" }
reflections { bounces = 2, glossy = true }

-- A workshop: a light bench below, dark where it ends, rows of lamps overhead and a window to the left.
background(function(x, y, z)
  local function band(a, half) return 1 - smoothstep(0.8 * half, half, abs(a)) end
  local bench = mix({0.2, 0.21, 0.23}, {0.6, 0.6, 0.58}, smoothstep(0, 0.45, -y))
  local room = mix(bench, {0.5, 0.54, 0.6}, smoothstep(-0.02, 0.7, y))
  local u, v = x / max(y, 0.05), z / max(y, 0.05)
  local lamps = band(fract(0.8 * u) - 0.5, 0.22) * band(v - 0.8, 1.3) * smoothstep(0.1, 0.3, y)
  local window = band(y / max(-x, 0.05) - 0.5, 0.5) * band(z / max(-x, 0.05) - 0.6, 0.5) * smoothstep(0.05, 0.1, -x)
  return mix(mix(room, {1.7, 1.65, 1.55}, lamps), {1.2, 1.4, 1.7}, window)
end)
