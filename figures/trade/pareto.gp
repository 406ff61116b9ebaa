# One panel a scene: |bias of T_z| over CPU seconds per 1000 cycles. What lies left and below costs
# less and errs less. Bars are standard errors; beside points t_c/dt, or k_n over the scene's.
load 'style.gp'
load '../bhateja2016/series.gp'
list = ' '
stats settings using (note(strcol(settings_scene))) nooutput
scenes = list
n = words(scenes)
set multiplot layout (n + 2) / 3, 3
set logscale xy
set yrange [0.1:20]
set ytics (0.1, 0.3, 1, 3, 10)
of(axis, k, value) = (strcol(settings_axis) eq axis && strcol(settings_scene) eq word(scenes, k)) ? value : NaN
size(value) = abs(value) > 0.1 ? abs(value) : 0.1
low(value, error) = abs(value) - error > 0.1 ? abs(value) - error : 0.1
array axes[4] = ['dt closed', 'dt stepped', 'dt uniform', 'k_n']
array marks[4] = [7, 6, 2, 9]
array tints[4] = [blue, orange, grey, vermillion]
do for [k = 1:n] {
  set title word(scenes, k) offset 0, -0.7
  set xlabel (k > n - 3 ? 'CPU s per 1000 cycles' : '') offset 0, 0.4
  set ylabel ((k - 1) % 3 == 0 ? '|bias of {/:Italic T}_z| [%]' : '') offset 1
  if (k == 1) { set key left bottom Left reverse font ',10' samplen 1 } else { unset key }
  plot for [a = 1:4] settings using (of(axes[a], k, column(settings_seconds_per_1000_cycles))):(size(column(settings_T_z_bias))):(low(column(settings_T_z_bias), column(settings_T_z_bias_se))):(size(abs(column(settings_T_z_bias)) + column(settings_T_z_bias_se))) \
         with yerrorbars pointtype marks[a] pointsize 0.8 linewidth 0.7 linecolor rgb tints[a] title axes[a], \
       for [a = 1:4] settings using (of(axes[a], k, column(settings_seconds_per_1000_cycles))):(size(column(settings_T_z_bias))):(sprintf('%g', column(settings_value))) \
         with labels offset 1.1, 0.4 font ',8' textcolor rgb tints[a]
}
unset multiplot
