# The large grain with interstitial air (initial height 43 d0) and among grains of several sizes (55 d0), at integer T.
load 'style.gp'
load 'rise.gp'
stats air_rise using (column(air_rise_grains)) nooutput
set label 8 sprintf('%d small grains', STATS_max) at screen 0.28, 0.975 center font ',11'
stats sizes_rise using (column(sizes_rise_grains)) nooutput
set label 9 sprintf('%d small grains', STATS_max) at screen 0.78, 0.975 center font ',11'
set multiplot
set lmargin at screen 0.07
set rmargin at screen 0.485
set label 1 '(a)' at graph 0.93, 0.06
array values[3] = ['0', '1e-3', '1e-2']
array labels[3] = ['no air', '{/:Italic b} = 10^{-3}', '{/:Italic b} = 10^{-2}']
plot for [v = 1:3] for [r = 1:6] air using (one_of(air_b_air, values[v], r, air_replicate) ? column(air_T) : NaN):(column(air_large_height)) \
       with linespoints pointtype 7 pointsize 0.35 linewidth 1.4 linecolor rgb hues[v], \
     for [v = 1:3] keyentry with lines linewidth 2 linecolor rgb hues[v] title labels[v]
set lmargin at screen 0.575
set rmargin at screen 0.985
set label 1 '(b)' at graph 0.93, 0.06
array values[2] = ['1 1', '0.9 1.1']
array labels[2] = ['one size', '0.9 to 1.1 {/:Italic d}_0']
plot for [v = 1:2] for [r = 1:6] sizes using (one_of(sizes_sizes, values[v], r, sizes_replicate) ? column(sizes_T) : NaN):(column(sizes_large_height)) \
       with linespoints pointtype 7 pointsize 0.35 linewidth 1.4 linecolor rgb hues[v], \
     for [v = 1:2] keyentry with lines linewidth 2 linecolor rgb hues[v] title labels[v]
unset multiplot
