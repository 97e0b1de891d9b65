-- Measuring shape S4: a gyroid sheet as a plain formula,max in a ball.
return field(function(x, y, z)
  local g = sin(5 * x) * cos(5 * y) + sin(5 * y) * cos(5 * z) + sin(5 * z) * cos(5 * x)
  return max(abs(g) / 8 - 0.05, length({x- y, z}) - 1.5)
end)
