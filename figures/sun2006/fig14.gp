# Fig. 14: mean over replicas and its standard error.
load 'style.gp'
# One replica has no spread.
known(n) = valid(n) ? column(n) : 0
set logscale y
set format y '10^{%T}'
set xrange [0:7]
set yrange [1e-4:2]
set xlabel '{/:Italic f = F}_n / <{/:Italic F}_n>'
set ylabel '{/:Italic P}({/:Italic f})'
set key right top Left reverse samplen 2
array sets[5] = ['pass 1', 'pass 2', 'pass 3', 'pass 4', 'all']
array marks[5] = [9, 5, 13, 2, 6]
array hues[5] = [vermillion, orange, green, blue, 'black']
array sizes[5] = [0.7, 0.6, 0.6, 0.6, 0.9]
array names[5] = ['1 pass', '2 passes', '3 passes', '4 passes', 'force networks']
plot for [k = 1:5] pdf using (strcol(pdf_set) eq sets[k] ? column(pdf_f) : NaN):(column(pdf_P) > 0 ? column(pdf_P) : NaN):(known(pdf_P_se)) \
  with yerrorbars pointtype marks[k] pointsize sizes[k] linecolor rgb hues[k] title names[k]
