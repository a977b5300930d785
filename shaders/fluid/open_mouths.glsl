// Which mouths are open, and how far their next layers have come. Needs `control` and `emitters`.
#ifndef RILL_OPEN_MOUTHS_GLSL
#define RILL_OPEN_MOUTHS_GLSL

struct OpenMouth {
  float phase;     // of the layer that leaves next, in layers: 0 where the last one was born, 1 where it is due itself
  float strength;  // grows from 0 to 1 while the first layer leaves
};

// Whether the emitter is open `later` seconds from now.
bool isOpen(uint e, float later, out OpenMouth mouth) {
  float now = control.timeHigh + control.timeLow + later, rate = emitters[e].rate;
  float since = (control.timeHigh - emitters[e].doneHigh) + (control.timeLow - emitters[e].doneLow) + later;
  float layers = rate * clamp(now - emitters[e].from, 0.0, since);
  mouth.phase = min(float(emitters[e].due) + float(emitters[e].phase) / 4294967296.0 + layers, 1.5);
  mouth.strength = min(emitters[e].opened + layers, 1.0);
  return rate > 0.0 && (emitters[e].blocked & kNoRoom) == 0u && now > emitters[e].from && now <= emitters[e].until;
}
#endif
