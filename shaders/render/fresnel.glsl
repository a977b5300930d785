// Reflectance of unpolarized light at this cosine, for a relative index of refraction above 1 (Fresnel equations).
float fresnel(float cosine, float index) {
  const float sine = sqrt(max(1.0 - cosine * cosine, 0.0)) / index;
  const float inner = sqrt(max(1.0 - sine * sine, 0.0));
  const float s = (cosine - index * inner) / (cosine + index * inner);
  const float p = (inner - index * cosine) / (inner + index * cosine);
  return 0.5 * (s * s + p * p);
}
