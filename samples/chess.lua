-- A chess set: six shapes, most of them turned from a profile, as 32 pieces on a board of 64 squares.

-- A foot and a stem up to a collar, all of one profile. Heads stand on it: the collar hides the joint.
local function stem(foot, waist, height)
  local outline = polygon {
    {0, 0}, {foot, 0}, {foot, 0.07}, {0.82 * foot, 0.13}, {0.82 * foot, 0.17},
    {waist + 0.05, 0.27}, {waist, 0.42}, {0.85 * waist, height}, {0, height},
  }
  local collar = rounded_rectangle(0.85 * waist + 0.09, 0.036, 0.036):translate(0, height, 0)
  return union { outline:round(0.012), collar, k = 0.04 }:revolve()
end

-- Copies of a cut around the axis, at this height.
local function around(cut, count, out, height)
  return cut:translate(out, height, 0):polar_repeat(count)
end

local function pawn()
  return stem(0.27, 0.12, 0.56) | sphere(0.165):translate(0, 0.72, 0)
end

local function rook()
  local tower = capped_cone(0.165, 0.235, 0.135):round(0.01):translate(0, 0.8, 0)
  local well = cylinder(0.155, 0.1):translate(0, 0.94, 0)
  local gaps = around(box(0.12, 0.06, 0.045), 6, 0.2, 0.945)
  return stem(0.31, 0.16, 0.68) | (tower - well - gaps)
end

local function knight()
  local head = polygon {
    {-0.16, 0.3}, {0.17, 0.3}, {0.08, 0.56}, {0.12, 0.66}, {0.27, 0.62}, {0.31, 0.72},
    {0.12, 0.97}, {0.06, 1.08}, {-0.02, 0.99}, {-0.17, 0.84}, {-0.23, 0.6},
  }
  local foot = cylinder(0.24, 0.04):round(0.03):translate(0, 0.24, 0)
  local base = capped_cone(0.3, 0.26, 0.07):round(0.012):translate(0, 0.085, 0)
  local body = union { head:extrude(0.05):round(0.05), foot, base, k = 0.05 }
  local eyes = sphere(0.028):translate(0.13, 0.84, 0.1):mirror("z")
  local mouth = box(0.09, 0.015, 0.2):rotate(0, 0, -12):translate(0.28, 0.68, 0)
  return body - eyes - mouth
end

local function bishop()
  local mitre = union { ellipsoid_bound(0.16, 0.23, 0.16):translate(0, 0.98, 0), sphere(0.04):translate(0, 1.22, 0), k = 0.02 }
  local slit = box(0.13, 0.022, 0.2):rotate(0, 0, 55):translate(0.12, 1.06, 0)
  return stem(0.29, 0.13, 0.76) | (mitre - slit)
end

local function queen()
  local cup = capped_cone(0.11, 0.21, 0.16):translate(0, 1.08, 0)
  local dents = around(sphere(0.06), 9, 0.22, 1.27)
  local bowl = sphere(0.16):translate(0, 1.34, 0)
  local pearl = sphere(0.075):translate(0, 1.26, 0)
  return stem(0.34, 0.15, 0.92) | union { cup - bowl - dents, pearl, k = 0.02 }
end

local function king()
  local cup = capped_cone(0.12, 0.2, 0.16):translate(0, 1.14, 0)
  local cap = capped_cone(0.2, 0.03, 0.035):translate(0, 1.33, 0)
  local cross = box(0.025, 0.12, 0.025) | box(0.085, 0.025, 0.025):translate(0, 0.03, 0)
  return stem(0.35, 0.155, 0.98) | union { cup, cap, cross:round(0.008):translate(0, 1.46, 0), k = 0.03 }
end

-- Each piece has the grain of its own wood.
local function wood(name, dark, light)
  return material {
    name = name,
    color = function(x, y, z)
      return mix(dark, light, 0.5 + 0.5 * sin(22 * y + 4 * noise(3 * x, y, 3 * z)))
    end,
    specular = 0.4, shininess = 50,
  }
end

local ranks = { rook, knight, bishop, queen, king, bishop, knight, rook }

-- One side's pieces, the pawns before the others; `side` is 1 at the front of the board and -1 at its back.
local function army(side, paint)
  local pieces = {}
  local function stand(piece, file, row)
    -- No player sets the pieces down quite straight.
    local facing = 90 * side + 20 * math.sin(5 * file + row)
    table.insert(pieces, piece():paint(paint):rotate(0, facing, 0):translate(file - 4.5, 0, side * row))
  end
  for file = 1, 8 do
    stand(ranks[file], file, 3.5)
    stand(pawn, file, 2.5)
  end
  return union(pieces)
end

part("white", army(1, wood("maple", {0.6, 0.42, 0.24}, {0.78, 0.62, 0.42})))
part("black", army(-1, wood("walnut", {0.06, 0.03, 0.018}, {0.12, 0.06, 0.03})))

part("board", box(4, 0.1, 4):translate(0, -0.1, 0):paint {
  name = "board", color = checkerboard({0.16, 0.075, 0.035}, {0.62, 0.45, 0.26}), specular = 0.2, shininess = 40,
})
part("frame", (round_box(4.35, 0.14, 4.35, 0.05) - box(4, 1, 4)):translate(0, -0.12, 0):paint {
  name = "frame", color = {0.13, 0.055, 0.025}, specular = 0.3, shininess = 40,
})

camera { from = {5.2, 4.6, 7.4}, to = {0.25, 0.05, 0.55}, fov = 40 }
directional_light { direction = {-1, 1.7, 0.9}, color = {1, 0.95, 0.86} }
directional_light { direction = {1, 1, 0.6}, color = {0.7, 0.85, 1}, intensity = 0.25, shadow = false }
ambient(0.22)
if value(param("shadows", 1)) > 0 then
  shadows { kind = "soft", sharpness = 12 }
end
ambient_occlusion { kind = "taps", spacing = 0.05, strength = 0.15 }
background(vertical_gradient({0.16, 0.15, 0.15}, {0.42, 0.45, 0.5}))
