-- Two dice: rounded boxes with pips sunk in, each in its own colour.

local function pips(face, places)
  local dots = {}
  for _, p in ipairs(places) do dots[#dots + 1] = sphere(0.17):translate(p[1], 1.08, p[2]) end
  return union(dots):rotate(face[1], face[2], face[3])
end

local o, a = 0, 0.5
local all = {
  pips({0, 0, 0}, {{o, o}}),
  pips({90, 0, 0}, {{-a, -a}, {a, a}}),
  pips({0, 0, 90}, {{-a, -a}, {o, o}, {a, a}}),
  pips({0, 0, -90}, {{-a, -a}, {-a, a}, {a, -a}, {a, a}}),
  pips({-90, 0, 0}, {{-a, -a}, {-a, a}, {a, -a}, {a, a}, {o, o}}),
  pips({180, 0, 0}, {{-a, -a}, {-a, o}, {-a, a}, {a, -a}, {a, o}, {a, a}}),
}
local body = round_box(1, 1, 1, 0.15) & sphere(1.5)

local function die(color)
  local plastic = material { color = color, specular = 0.5, shininess = 80 }
  return body:paint(plastic) - union(all)
end

part("ivory die", die({0.85, 0.8, 0.7}):rotate(0, 25, 0):translate(-1.5, 0, 0))
part("red die", die({0.6, 0.06, 0.08}):rotate(90, 0, 0):rotate(0, -35, 0):translate(1.4, 0, 0.6))

camera { from = {0.5, 3.4, 5.5}, to = {0, -0.1, 0}, fov = 42 }
directional_light { direction = {0.6, 1.5, 0.8} }
ambient(0.2)
background({0.12, 0.3, 0.2})
