// The quantity that depth filters smooth, linear across a plane: inverse depth in perspective, else depth (m).
float toLinear(float z) { return view.perspective > 0.0 ? 1.0 / z : z; }
float toDepth(float q) { return view.perspective > 0.0 ? 1.0 / q : q; }
// Derivative of depth.
float depthPerLinear(float z) { return view.perspective > 0.0 ? -z * z : 1.0; }
float metersASample(float z) { return metersAPixel(z) * float(view.step); }
