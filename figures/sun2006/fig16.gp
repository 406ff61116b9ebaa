# Fig. 16: F(r) of Eq. (12), mean over replicas and its standard error.
load 'style.gp'
# One replica has no spread.
known(n) = valid(n) ? column(n) : 0
set xrange [0:6]
set yrange [*:*]
set xlabel '{/:Italic r}/{/:Italic d}_0'
set ylabel '{/:Italic F}({/:Italic r})'
set key right top Left reverse samplen 2
array sets[5] = ['pass 1', 'pass 2', 'pass 3', 'pass 4', 'all']
array marks[5] = [9, 5, 13, 2, 6]
array hues[5] = [vermillion, orange, green, blue, 'black']
array names[5] = ['1 pass', '2 passes', '3 passes', '4 passes', 'force networks']
plot for [k = 1:5] correlation using (strcol(correlation_set) eq sets[k] ? column(correlation_r) : NaN):(column(correlation_F)):(known(correlation_F_se)) \
  with yerrorlines pointtype marks[k] pointsize 0.5 linewidth 1 linecolor rgb hues[k] title names[k]
