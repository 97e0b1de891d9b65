-- A small planet: noise raises its land, a second sphere is the sea, and colours follow the height.

local relief = param("relief", 0.12, {min = 0, max = 0.15})

local land = sphere(1):displace(function(x, y, z)
  return -relief * noise(1.8 * x, 1.8 * y, 1.8 * z, {octaves = 4})
end)
local soil = material {
  name = "land",
  color = function(x, y, z)
    local height = length({x, y, z}) - 1
    local low = mix({0.65, 0.6, 0.4}, {0.15, 0.4, 0.12}, smoothstep(0, 0.02, height))
    return mix(low, {0.9, 0.9, 0.92}, smoothstep(0.05, 0.09, height))
  end,
  shininess = 10,
}
local water = material { name = "sea", color = {0.05, 0.2, 0.45}, specular = 0.7, shininess = 120, reflectivity = 0.3, fresnel_power = 4 }
part("planet", sphere(1):paint(water) | land:paint(soil))

camera { from = {0, 0.8, 3.4}, to = {0, 0, 0}, fov = 42 }
directional_light { direction = {1, 0.8, 0.6} }
ambient(0.06)
background({0.005, 0.005, 0.015})
