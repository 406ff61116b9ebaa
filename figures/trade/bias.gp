# Left: T_z against the reference over steps per contact; isolated contacts in closed form (filled)
# and all contacts stepped (open). Right: against the hardest grains over k_n. The grey band is what
# `accuracy` reckons with: the bound of the worst scene with contacts in closed form.
load 'style.gp'
load '../bhateja2016/series.gp'
list = ' '
stats settings using (note(strcol(settings_scene))) nooutput
scenes = list
n = words(scenes)
bound(axis, sign) = strcol(bounds_axis) eq axis ? sign * column(bounds_bias_bound) : NaN
of(axis, k, value) = (strcol(settings_axis) eq axis && strcol(settings_scene) eq word(scenes, k)) ? value : NaN
set multiplot layout 1, 2
set logscale x
set xrange [4.4:60]
set xtics (5, 7, 10, 14, 20, 50)
set yrange [-15:4]
set xlabel '{/:Italic t}_c / {/:Italic dt}'
set ylabel 'bias of {/:Italic T}_z [%]'
set key right bottom Left reverse font ",11"
beside(k) = column(settings_value) * (1 + 0.012 * (k - n / 2.0))
plot for [k = 1:n] settings using (of('dt closed', k, beside(k))):(column(settings_T_z_bias)):(column(settings_T_z_bias_se)) \
       with yerrorbars pointtype shape(k) pointsize 0.9 linecolor rgb tone(k, n) notitle, \
     for [k = 1:n] settings using (of('dt stepped', k, beside(k))):(column(settings_T_z_bias)):(column(settings_T_z_bias_se)) \
       with yerrorbars pointtype open_shape(k) pointsize 0.9 linecolor rgb tone(k, n) notitle, \
     keyentry with points pointtype 7 linecolor rgb grey title 'filled: contacts in closed form', \
     keyentry with points pointtype 6 linecolor rgb grey title 'open: every contact stepped', \
     for [s = -1:1:2] bounds using (column(bounds_value)):(bound('dt closed', s)) with lines linecolor rgb grey dashtype '-' title (s < 0 ? 'what `accuracy` reckons with' : '')
set xrange [0.022:40]
set xtics (0.03, 0.1, 0.3, 1, 3, 10, 30)
set yrange [-4:36]
set xlabel '{/:Italic k}_n over that of `auto`'
set ylabel 'bias of {/:Italic T}_z against the hardest [%]'
set key right top Left reverse font ",11" maxrows 9
plot for [k = 1:n] settings using (of('k_n', k, beside(k))):(column(settings_T_z_bias)):(column(settings_T_z_bias_se)) \
       with yerrorbars pointtype shape(k) pointsize 0.9 linecolor rgb tone(k, n) title word(scenes, k), \
     for [s = -1:1:2] bounds using (column(bounds_value)):(bound('k_n', s)) with lines linecolor rgb grey dashtype '-' notitle, \
     0 with lines linecolor rgb light notitle
unset multiplot
