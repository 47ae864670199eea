// A scope's flat picture out of focus, on a coarser grid: the mean of TAPS places over a disc.
in vec2 v_at;

uniform sampler2D u_flat;
uniform float u_spread;  // the disc's radius, of the picture's side

out vec4 o_light;

void main() {
  vec3 sum = vec3(0.0);
  for (int k = 0; k < TAPS; ++k) {
    float a = 2.39996 * float(k), q = sqrt((float(k) + 0.7) / float(TAPS));
    sum += texture(u_flat, v_at + u_spread * q * vec2(cos(a), sin(a))).rgb;
  }
  o_light = vec4(sum / float(TAPS), 1.0);
}
