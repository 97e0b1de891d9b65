-- MeaŒhturn
return sphere(2)
