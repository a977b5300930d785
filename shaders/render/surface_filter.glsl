// What the depth filters work on: a sample's inverse depth in perspective (linear across a plane), else its depth, in meters around it.
float toLinear(float z) { return view.perspective > 0.0 ? 1.0 / z : z; }
float toDepth(float q) { return view.perspective > 0.0 ? 1.0 / q : q; }
// How much depth changes with it.
float depthPerLinear(float z) { return view.perspective > 0.0 ? -z * z : 1.0; }
float metersASample(float z) { return metersAPixel(z) * float(view.step); }
