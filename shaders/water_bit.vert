// A square in the water before a scope: of a bubble or a flake of loose tissue.
in vec3 a_position;  // its middle, view space
in vec3 a_normal;    // from there to this corner
in vec4 a_shade;     // place in the square, -1 to 1; 0 bubble, 1 flake; which shape

uniform mat4 u_clip_from_view;

out vec3 v_position;
out vec2 v_in_square;
out vec2 v_kind;

void main() {
  v_position = a_position + a_normal;
  v_in_square = a_shade.xy;
  v_kind = a_shade.zw;
  gl_Position = u_clip_from_view * vec4(v_position, 1.0);
  // A bubble hides by its front, not by its middle: what it clings to does not cut it in two.
  float front_m = a_shade.z < 0.5 ? length(a_normal) : 0.0;
  vec4 front = u_clip_from_view * vec4(v_position * (1.0 - front_m / length(v_position)), 1.0);
  gl_Position.z = front.z / front.w * gl_Position.w;
}
