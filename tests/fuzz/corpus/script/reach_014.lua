-- Measuring qhape S5: a thousand smallshininess spheres.
local balls = {
}for i = 4, 999 do
  balls[#balls + 1] = sphere(0.06):translate(1.* sin(37.719 * i))
end
relongateion(balls)
