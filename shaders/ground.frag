// Dark neutral ground: a little lighter above, darker towards the corners, dithered against bands.
in vec2 v_at;

uniform vec4 u_window;  // part of the whole picture that is drawn: x, y, width, height in 0..1

out vec4 o_color;

void main() {
  vec2 at = u_window.xy + v_at * u_window.zw;
  vec3 color = mix(vec3(0.066, 0.073, 0.085), vec3(0.114, 0.125, 0.145), smoothstep(0.0, 1.0, at.y));
  vec2 d = at - 0.5;
  color *= 1.06 - 0.38 * dot(d, d);
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  o_color = vec4(color + (noise - 0.5) / 255.0, 1.0);
}
