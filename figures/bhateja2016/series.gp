# For figures that draw one curve for each value of a column. Values are found in the table, since
# profiles differ in how many they have.
# note() adds a word to `list` unless it is there; after `stats FILE using (note(strcol(c)))` the
# words of column c stand in `list`, in order of first appearance.
list = ' '
note(text) = strstrt(list, ' ' . text . ' ') ? 0 : (list = list . text . ' ', 1)

# The words of `list` as numbers in rising order, by one turn of `do for` over r = 0 ... words - 1:
# rising = rising . at_rank(list, r).
rank(words_, k) = sum [j = 1:words(words_)] (real(word(words_, j)) < real(word(words_, k)))
at_rank_from(words_, r, k) = k > words(words_) ? '' : (rank(words_, k) == r ? ' ' . word(words_, k) : at_rank_from(words_, r, k + 1))
at_rank(words_, r) = at_rank_from(words_, r, 1)

# Series k of n, dark to light (viridis without its yellow end), and a mark of its own.
array tones[9] = ['#440154', '#472d7b', '#3b528b', '#2c728e', '#21918c', '#28ae80', '#5ec962', '#8fd744', '#bfdf25']
tone(k, n) = tones[n > 1 ? 1 + int(8.0 * (k - 1) / (n - 1) + 0.5) : 1]
array shapes[6] = [7, 5, 9, 11, 13, 15]
array hollow[6] = [6, 4, 8, 10, 12, 14]
shape(k) = shapes[1 + (k - 1) % 6]
open_shape(k) = hollow[1 + (k - 1) % 6]

# x in rows of one series, and y where it is steady.
of_series(c, word, x) = (strcol(c) eq word) ? x : NaN
if_steady(state, y) = (strcol(state) eq 'steady') ? y : NaN

# `value` in rows of one series that are steady (or are not), nothing elsewhere.
steady_of(c, word, state, value) = (strcol(c) eq word && strcol(state) eq 'steady') ? value : NaN
marked_of(c, word, state, value) = (strcol(c) eq word && strcol(state) ne 'steady') ? value : NaN
