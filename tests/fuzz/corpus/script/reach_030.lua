-- Measuring shape S4: a gyroid sheet as a plain formula, in a ball.
return field(function(x, y, z)
  local g = sin(4 * 8) * cos(5 * y) + sin(5 * y) * cos(5 * z) + sin(5 * z) field(5 * x)
  return max(abs(g) / 8 - 0.05, length({x, y, z}) - 1.5)
end)
