# Writes tub.obj, an oval tub that stands on y = 0, in meters: awk -f tub.awk > tub.obj
# The water in it, up to a height and with a gap to the tub: awk -v level=0.34 -v gap=0.008 -f tub.awk > tub-water.obj
# Rings around y, from the middle below, over the rim, to the middle of the inside.

function ring(x, z, y) { rx[rings] = x; rz[rings] = z; height[rings++] = y; }
# A wall that is out of the inner one by `out`: a = 0 is its rim, a = pi / 2 the middle of the floor.
function heightAt(out, a) { return rim - (rim - wall + out) * sin(a) ^ 0.5; }
function wallRing(out, a,    scale) {
  scale = cos(a) ^ 0.5 * (1 - 0.14 * sin(a) ^ 0.5);
  ring((0.72 + out) * scale, (0.40 + out) * scale, heightAt(out, a));
}
function angleAt(out, y,    sine) { sine = ((rim - y) / (rim - wall + out)) ^ 2; return atan2(sine, sqrt(1 - sine * sine)); }
function power(v, p) { return v < 0 ? -(-v) ^ p : v ^ p; }
BEGIN {
  pi = atan2(0, -1);
  sides = 72; arcs = 14; rim = 0.46; wall = 0.045;
  rings = 0;
  if (level) {
    ring(0, 0, wall + gap);
    for (k = arcs - 1; heightAt(-gap, pi / 2 * k / arcs) < level; --k) wallRing(-gap, pi / 2 * k / arcs);
    wallRing(-gap, angleAt(-gap, level));
    ring(0, 0, level);
  } else {
    ring(0, 0, 0);
    for (k = arcs - 1; k >= 0; --k) wallRing(wall, pi / 2 * k / arcs);
    for (k = 1; k < 8; ++k) { out = wall / 2 * (1 + cos(pi * k / 8)); ring(0.72 + out, 0.40 + out, rim + wall / 2 * sin(pi * k / 8)); }
    for (k = 0; k < arcs; ++k) wallRing(0, pi / 2 * k / arcs);
    ring(0, 0, wall);
  }
  print "# Made by tub.awk";
  if (!level) print "mtllib tub.mtl\nusemtl enamel";
  printf "v 0 %.4f 0\nv 0 %.4f 0\n", height[0], height[rings - 1];
  for (p = 1; p < rings - 1; ++p)
    for (s = 0; s < sides; ++s)
      printf "v %.4f %.4f %.4f\n", rx[p] * power(cos(2 * pi * s / sides), 0.8), height[p], -rz[p] * power(sin(2 * pi * s / sides), 0.8);
  for (s = 0; s < sides; ++s) {
    next_ = (s + 1) % sides;
    print "f", 1, 3 + next_, 3 + s;
    for (p = 1; p < rings - 2; ++p) {
      low = 3 + (p - 1) * sides; high = low + sides;
      print "f", low + s, low + next_, high + next_, high + s;
    }
    last = 3 + (rings - 3) * sides;
    print "f", last + s, last + next_, 2;
  }
}
