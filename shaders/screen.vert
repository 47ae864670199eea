// One triangle over the whole viewport.
uniform float u_screen_depth;  // clip z, -1 nearest

out vec2 v_at;  // 0..1 from the lower left corner

void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  v_at = corner;
  gl_Position = vec4(corner * 2.0 - 1.0, u_screen_depth, 1.0);
}
