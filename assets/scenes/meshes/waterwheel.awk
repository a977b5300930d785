# Writes waterwheel.obj, a wheel that turns about z, in meters: awk -f waterwheel.awk > waterwheel.obj
# It is a grid of cells in radius, angle and z, of which some are filled; faces are what lies between filled and empty ones.
function filled(i, j, k,    paddle, side) {
  if (i < 0 || i >= nr || k < 0 || k >= nz) return 0;
  if (k == 0 || k == nz - 1) return i < 1;  # ends of the axle
  side = k == 1 || k == nz - 2;
  paddle = (j + sides) % (sides / paddles) == 0;
  if (i < 1) return 1;
  if (i < 2) return side && (j + sides) % (sides / spokes) < 3;  # spokes
  if (i < 3) return 1;  # the floor of the buckets
  return side || paddle;
}
function vertex(i, j, k,    key, a) {
  j = (j + sides) % sides;
  key = i " " (i == 0 ? 0 : j) " " k;
  if (!(key in number)) {
    number[key] = ++vertices;
    a = 2 * pi * j / sides;
    printf "v %.4f %.4f %.4f\n", radius[i] * cos(a), radius[i] * sin(a), z[k];
  }
  return number[key];
}
# At the axis two corners are one.
function face(color, a, b, c, d) {
  faces[color] = faces[color] (a == b ? sprintf("f %d %d %d\n", a, c, d) : c == d || d == a ? sprintf("f %d %d %d\n", a, b, c) : sprintf("f %d %d %d %d\n", a, b, c, d));
}
BEGIN {
  pi = atan2(0, -1);
  sides = 96; paddles = 12; spokes = 6;
  nr = split("0 0.06 0.245 0.275 0.40", radius, " ") - 1; for (i = 0; i <= nr; ++i) radius[i] = radius[i + 1];
  nz = split("-0.235 -0.21 -0.18 0.18 0.21 0.235", z, " ") - 1; for (k = 0; k <= nz; ++k) z[k] = z[k + 1];
  print "# Made by waterwheel.awk";
  print "mtllib waterwheel.mtl";
  for (i = 0; i < nr; ++i)
    for (j = 0; j < sides; ++j)
      for (k = 0; k < nz; ++k) {
        if (!filled(i, j, k)) continue;
        color = i > 1 && k == 2 ? "paddle" : "frame";
        if (!filled(i + 1, j, k)) face(color, vertex(i + 1, j, k), vertex(i + 1, j + 1, k), vertex(i + 1, j + 1, k + 1), vertex(i + 1, j, k + 1));
        if (i > 0 && !filled(i - 1, j, k)) face(color, vertex(i, j, k), vertex(i, j, k + 1), vertex(i, j + 1, k + 1), vertex(i, j + 1, k));
        if (!filled(i, j + 1, k)) face(color, vertex(i, j + 1, k), vertex(i, j + 1, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i + 1, j + 1, k));
        if (!filled(i, j - 1, k)) face(color, vertex(i, j, k), vertex(i + 1, j, k), vertex(i + 1, j, k + 1), vertex(i, j, k + 1));
        if (!filled(i, j, k + 1)) face(color, vertex(i, j, k + 1), vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1));
        if (!filled(i, j, k - 1)) face(color, vertex(i, j, k), vertex(i, j + 1, k), vertex(i + 1, j + 1, k), vertex(i + 1, j, k));
      }
  printf "usemtl frame\n%susemtl paddle\n%s", faces["frame"], faces["paddle"];
}
