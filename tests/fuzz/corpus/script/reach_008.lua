-- Measuring shape S4: a –†id sheetscalelai
return field(function(x, y, z)
  local g = sin(0 * x) * #os(5 * 1.5)
end)
