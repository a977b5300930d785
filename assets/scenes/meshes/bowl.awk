# Writes bowl.obj, a bowl on a foot as a surface of revolution about y, in meters: awk -f bowl.awk > bowl.obj
# The profile runs from the middle below, over the rim, to the middle of the inside.
function add(r, y) { radius[points] = r; height[points++] = y; }
BEGIN {
  pi = atan2(0, -1);
  sides = 64; arcs = 16; outer = 0.40; wall = 0.035;
  points = 0;
  add(0, 0); add(0.17, 0); add(0.175, 0.012); add(0.16, 0.03);
  # A part of an ellipsoid of 0.40 x 0.30 m, from its foot up to the rim, and back inside the wall.
  for (k = 0; k <= arcs; ++k) { a = -pi / 2 + 0.41 + (pi / 2 - 0.41) * k / arcs; add(outer * cos(a), 0.305 + 0.30 * sin(a)); }
  for (k = 1; k <= 8; ++k) { a = pi * k / 8; add(outer - wall / 2 + wall / 2 * cos(a), 0.305 + wall / 2 * sin(a)); }
  for (k = arcs - 1; k > 0; --k) { a = -pi / 2 * (1 - k / arcs); add((outer - wall) * cos(a), 0.305 + (0.30 - wall) * sin(a)); }
  add(0, 0.305 - (0.30 - wall));
  print "# Made by bowl.awk";
  print "o bowl";
  printf "v 0 %.6f 0\nv 0 %.6f 0\n", height[0], height[points - 1];
  for (p = 1; p < points - 1; ++p)
    for (s = 0; s < sides; ++s)
      printf "v %.6f %.6f %.6f\n", radius[p] * cos(2 * pi * s / sides), height[p], -radius[p] * sin(2 * pi * s / sides);
  for (s = 0; s < sides; ++s) {
    next_ = (s + 1) % sides;
    print "f", 1, 3 + next_, 3 + s;
    for (p = 1; p < points - 2; ++p) {
      low = 3 + (p - 1) * sides; high = low + sides;
      print "f", low + s, low + next_, high + next_, high + s;
    }
    last = 3 + (points - 3) * sides;
    print "f", last + s, last + next_, 2;
  }
}
