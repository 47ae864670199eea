// A disc in the middle of the viewport, as a fan of 48 corners and the first one again.
uniform vec2 u_disc;  // its radius, clip space

out vec2 v_at;  // 0..1 from the viewport's lower left corner

void main() {
  const float kStep = 6.2831853 / 48.0;
  float a = kStep * float(gl_VertexID);
  vec2 at = u_disc * vec2(cos(a), sin(a)) / cos(0.5 * kStep);
  v_at = 0.5 + 0.5 * at;
  gl_Position = vec4(at, 0.0, 1.0);
}
